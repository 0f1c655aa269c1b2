#include "server/drivers/camera/cameras.hpp"

#include <fstream>

#include <gtest/gtest.h>
#include <opencv2/videoio.hpp>

#include "common/image/png.hpp"
#include "tests/unit/server/store/temporary_folder.hpp"

namespace seeker::drivers {
namespace {

using namespace std::chrono_literals;
using seeker::testing::TemporaryFolder;

/// Gives pictures when the test says so.
class Script {
 public:
  void give(Image picture) {
    const std::scoped_lock lock(mutex_);
    pictures_.push_back(std::move(picture));
    changed_.notify_all();
  }
  void end() {
    const std::scoped_lock lock(mutex_);
    ended_ = true;
    changed_.notify_all();
  }
  /// The next reading fails, once.
  void fail_once() {
    const std::scoped_lock lock(mutex_);
    fails_ = true;
    changed_.notify_all();
  }
  Result<Image> take() {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return ended_ || fails_ || !pictures_.empty(); });
    if (std::exchange(fails_, false) || pictures_.empty()) {
      return fail(Errc::kIo, "the cable is out");
    }
    Image picture = std::move(pictures_.front());
    pictures_.pop_front();
    return picture;
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<Image> pictures_;
  bool ended_ = false;
  bool fails_ = false;
};

class ScriptedSource final : public PictureSource {
 public:
  explicit ScriptedSource(std::shared_ptr<Script> script, bool comes_back = false)
      : script_(std::move(script)), comes_back_(comes_back) {}
  ~ScriptedSource() override { script_->end(); }
  Status open() override { return {}; }
  Result<Image> read() override { return script_->take(); }
  void close() override {}
  [[nodiscard]] bool comes_back() const override { return comes_back_; }

 private:
  std::shared_ptr<Script> script_;
  bool comes_back_;
};

/// Robot time that the test sets.
struct TestClock {
  std::shared_ptr<std::atomic<std::int64_t>> ns = std::make_shared<std::atomic<std::int64_t>>(0);
  void set(Duration time) const { ns->store(time.count()); }
  [[nodiscard]] NowFunction function() const {
    return [shared = ns] { return RobotTime(Duration(shared->load())); };
  }
};

/// A reader that can be waited for and is stopped before the source's script ends.
struct Reader {
  explicit Reader(const PictureReaderParams& params = {}, bool comes_back = false)
      : reader("the test camera", std::make_unique<ScriptedSource>(script, comes_back), clock.function(), params) {}
  ~Reader() { script->end(); }
  std::shared_ptr<Script> script = std::make_shared<Script>();
  TestClock clock;
  PictureReader reader;
};

TEST(PictureReader, HandsOverTheNewestPictureAndRefusesOldOnes) {
  Reader r;
  EXPECT_EQ(r.reader.pictures().error().code, Errc::kNotReady);
  r.reader.start();
  EXPECT_EQ(r.reader.pictures().error().code, Errc::kNotReady);
  r.clock.set(1s);
  r.script->give(Image(4, 4, 1, 7));
  ASSERT_TRUE(r.reader.wait_for_picture(5s));
  const auto fresh = r.reader.pictures();
  ASSERT_TRUE(fresh) << fresh.error().message;
  EXPECT_EQ(fresh->back().stamp, robot_time_s(1.0));
  EXPECT_EQ(*fresh->back().image.at(0, 0), 7);
  r.clock.set(1600ms);
  EXPECT_EQ(r.reader.pictures().error().code, Errc::kTimeout);
}

TEST(PictureReader, TellsWhenNoPictureEverComesAndWhatTheDeviceSaid) {
  Reader r;
  r.reader.start();
  r.clock.set(6s);
  EXPECT_EQ(r.reader.pictures().error().code, Errc::kTimeout);
  r.script->end();
  ASSERT_TRUE(r.reader.wait_for_picture(5s));
  const auto failed = r.reader.pictures();
  EXPECT_EQ(failed.error().code, Errc::kIo);
  EXPECT_NE(failed.error().message.find("the test camera: the cable is out"), std::string::npos);
}

TEST(PictureReader, OpensADeviceThatFailedAnew) {
  PictureReaderParams params;
  params.reopen_after = 1ms;
  Reader r(params, true);
  r.reader.start();
  r.script->fail_once();
  ASSERT_TRUE(r.reader.wait_for_picture(5s));
  EXPECT_EQ(r.reader.pictures().error().code, Errc::kIo);
  r.script->give(Image(4, 4, 1, 7));
  auto again = r.reader.pictures();
  for (const auto end = std::chrono::steady_clock::now() + 5s; !again && std::chrono::steady_clock::now() < end;) {
    std::this_thread::yield();
    again = r.reader.pictures();
  }
  ASSERT_TRUE(again) << again.error().message;
  EXPECT_EQ(*again->back().image.at(0, 0), 7);
}

TEST(PictureReader, StopsWhileItWaitsToOpenADeviceAnew) {
  PictureReaderParams params;
  params.reopen_after = std::chrono::hours(1);
  Reader r(params, true);
  r.reader.start();
  r.script->fail_once();
  ASSERT_TRUE(r.reader.wait_for_picture(5s));
  r.reader.stop();
  EXPECT_EQ(r.reader.pictures().error().code, Errc::kIo);
}

StereoGeometry small_geometry() { return {32, 24, 40.0, 16.0, 12.0, 0.1}; }

/// Two devices whose pictures come at times of the test's choice.
struct TwoDevices {
  TwoDevices() {
    std::vector<std::unique_ptr<PictureSource>> sources;
    sources.push_back(std::make_unique<ScriptedSource>(left));
    sources.push_back(std::make_unique<ScriptedSource>(right));
    camera = make_stereo_camera(std::move(sources), {}, Rectifier::none(small_geometry()).value(), clock.function());
    EXPECT_TRUE(camera->activate());
  }
  ~TwoDevices() {
    left->end();
    right->end();
    camera->deactivate();
  }
  /// Waits until the camera's answer is no longer `old`.
  Result<StereoFrame> grab_until(const std::function<bool(const Result<StereoFrame>&)>& good) const {
    Result<StereoFrame> frame = camera->grab();
    for (int i = 0; i < 100000 && !good(frame); ++i) {
      std::this_thread::yield();
      frame = camera->grab();
    }
    return frame;
  }
  std::shared_ptr<Script> left = std::make_shared<Script>();
  std::shared_ptr<Script> right = std::make_shared<Script>();
  TestClock clock;
  std::unique_ptr<StereoDriver> camera;
};

TEST(TwoDeviceCamera, PairsPicturesOfOneMomentAndRefusesOthers) {
  TwoDevices d;
  d.clock.set(1s);
  d.left->give(Image(32, 24, 1, 10));
  d.right->give(Image(32, 24, 1, 20));
  const auto pair = d.grab_until([](const auto& f) { return f.has_value(); });
  ASSERT_TRUE(pair) << pair.error().message;
  EXPECT_EQ(*pair->left.at(0, 0), 10);
  EXPECT_EQ(*pair->right.at(0, 0), 20);
  EXPECT_EQ(pair->stamp, robot_time_s(1.0));
  // 600 ms later only the right one goes on: the left one is too old.
  d.clock.set(1600ms);
  d.right->give(Image(32, 24, 1, 21));
  const auto silent = d.grab_until([](const auto& f) { return !f.has_value(); });
  EXPECT_EQ(silent.error().code, Errc::kTimeout);
  EXPECT_NE(silent.error().message.find("left camera"), std::string::npos);
}

TEST(TwoDeviceCamera, TellsPicturesThatAreNotOfOneMoment) {
  TwoDevices d;
  d.clock.set(1s);
  d.left->give(Image(32, 24, 1, 10));
  ASSERT_EQ(
      d.grab_until([](const auto& f) { return f.error().message.find("right") != std::string::npos; }).error().code,
      Errc::kNotReady);
  d.clock.set(1200ms);
  d.right->give(Image(32, 24, 1, 20));
  const auto apart = d.grab_until([](const auto& f) { return f.error().code != Errc::kNotReady; });
  EXPECT_EQ(apart.error().code, Errc::kTimeout);
  EXPECT_NE(apart.error().message.find("200 ms apart"), std::string::npos) << apart.error().message;
}

TEST(TwoDeviceCamera, RefusesAnotherPictureSizeAtRunTime) {
  TwoDevices d;
  d.clock.set(1s);
  d.left->give(Image(32, 24, 1, 10));
  d.right->give(Image(16, 12, 1, 20));
  const auto frame = d.grab_until([](const auto& f) { return f.error().code != Errc::kNotReady; });
  EXPECT_EQ(frame.error().code, Errc::kInvalidArgument);
  EXPECT_NE(frame.error().message.find("the right picture is 16x12"), std::string::npos) << frame.error().message;
}

TEST(SideBySideCamera, PlaysAVideoFileAndCutsItInTwo) {
  const TemporaryFolder folder;
  const std::string file = (folder.path() / "both.avi").string();
  cv::VideoWriter writer(file, cv::CAP_OPENCV_MJPEG, cv::VideoWriter::fourcc('M', 'J', 'P', 'G'), 10.0,
                         cv::Size(64, 24));
  ASSERT_TRUE(writer.isOpened());
  cv::Mat picture(24, 64, CV_8UC3, cv::Scalar::all(40));
  picture.colRange(32, 64).setTo(cv::Scalar::all(200));
  writer.write(picture);
  writer.release();

  const std::unique_ptr<PictureSource> source = make_capture_source({file, 0, 0, 0.0});
  ASSERT_TRUE(source->open());
  const Result<Image> both = source->read();
  ASSERT_TRUE(both) << both.error().message;
  EXPECT_EQ(both->width_px(), 64);
  EXPECT_EQ(source->read().error().code, Errc::kIo);  // the file has ended

  auto script = std::make_shared<Script>();
  std::vector<std::unique_ptr<PictureSource>> sources;
  sources.push_back(std::make_unique<ScriptedSource>(script));
  const TestClock clock;
  const auto camera =
      make_stereo_camera(std::move(sources), {}, Rectifier::none(small_geometry()).value(), clock.function());
  ASSERT_TRUE(camera->activate());
  script->give(*both);
  Result<StereoFrame> frame = camera->grab();
  for (int i = 0; i < 100000 && !frame; ++i) {
    std::this_thread::yield();
    frame = camera->grab();
  }
  script->end();
  ASSERT_TRUE(frame) << frame.error().message;
  EXPECT_NEAR(*frame->left.at(16, 12), 40, 4);
  EXPECT_NEAR(*frame->right.at(16, 12), 200, 4);
}

TEST(CaptureSource, TellsADeviceThatIsNotThere) {
  const auto source = make_capture_source({"/dev/video-that-is-not-there", 640, 480, 30.0});
  const Status opened = source->open();
  EXPECT_EQ(opened.error().code, Errc::kNotFound);
  EXPECT_NE(opened.error().message.find("/dev/video-that-is-not-there"), std::string::npos);
}

StereoCameraParams folder_params(const std::filesystem::path& folder) {
  StereoCameraParams params;
  params.source = StereoSource::kFiles;
  params.files.folder = folder;
  params.geometry = small_geometry();
  return params;
}

TEST(FolderCamera, PlaysPairsInTheOrderOfTheirNumbersThenSaysSo) {
  const TemporaryFolder folder;
  for (const int n : {10, 9, 1}) {
    const std::string name = (folder.path() / std::to_string(n)).string();
    ASSERT_TRUE(image::write_png(name + "_left.png", Image(32, 24, 1, static_cast<std::uint8_t>(n))));
    ASSERT_TRUE(image::write_png(name + "_right.png", Image(32, 24, 3, static_cast<std::uint8_t>(100 + n))));
  }
  const TestClock clock;
  StereoCameraParams params = folder_params(folder.path());
  const auto camera = make_stereo_camera(params, clock.function());
  ASSERT_TRUE(camera) << camera.error().message;
  EXPECT_EQ((*camera)->grab().error().code, Errc::kNotReady);
  ASSERT_TRUE((*camera)->activate());
  for (const int n : {1, 9, 10}) {
    const auto frame = (*camera)->grab();
    ASSERT_TRUE(frame) << frame.error().message;
    EXPECT_EQ(*frame->left.at(3, 3), n);
    EXPECT_EQ(*frame->right.at(3, 3), 100 + n);
    EXPECT_EQ(frame->right.channels(), 1);
  }
  EXPECT_EQ((*camera)->grab().error().code, Errc::kCancelled);
  params.repeat_files = true;
  const auto again = make_stereo_camera(params, clock.function());
  ASSERT_TRUE((*again)->activate());
  for (int i = 0; i < 7; ++i) {
    EXPECT_TRUE((*again)->grab());
  }
}

TEST(ImageFolder, TellsWhatIsMissing) {
  const TemporaryFolder folder;
  ImageFolderParams params;
  params.folder = folder.path();
  EXPECT_EQ(list_image_pairs(params).error().code, Errc::kNotFound);
  std::ofstream(folder.path() / "a_left.png") << "x";
  const auto lonely = list_image_pairs(params);
  EXPECT_EQ(lonely.error().code, Errc::kInvalidArgument);
  EXPECT_NE(lonely.error().message.find("'a'"), std::string::npos);
  std::ofstream(folder.path() / "a_right.jpg") << "x";
  EXPECT_TRUE(list_image_pairs(params));
  params.poses = "poses.csv";
  EXPECT_EQ(list_image_pairs(params).error().code, Errc::kNotFound);
  std::ofstream(folder.path() / "poses.csv") << "name,x_m,y_m,theta_deg\na,1.5,-2,90\n";
  const auto posed = list_image_pairs(params);
  ASSERT_TRUE(posed) << posed.error().message;
  ASSERT_TRUE((*posed)[0].map_T_eye);
  EXPECT_NEAR((*posed)[0].map_T_eye->theta_rad, 1.5707963, 1e-6);
  std::ofstream(folder.path() / "poses.csv") << "name,x_m,y_m,theta_deg\na,1.5,south,90\n";
  EXPECT_EQ(list_image_pairs(params).error().code, Errc::kParse);
  std::ofstream(folder.path() / "poses.csv") << "name,x_m,y_m,theta_deg\n";
  EXPECT_EQ(list_image_pairs(params).error().code, Errc::kInvalidArgument);
  params.left_pattern = "left.png";
  EXPECT_EQ(list_image_pairs(params).error().code, Errc::kInvalidArgument);
}

TEST(ImageFolder, PatternsGiveTheNameOfThePair) {
  EXPECT_EQ(match_pattern("12_left.jpg", "*_left.*"), "12");
  EXPECT_EQ(match_pattern("left_012.png", "left_*.png"), "012");
  EXPECT_EQ(match_pattern("12_right.jpg", "*_left.*"), std::nullopt);
  EXPECT_EQ(match_pattern("_left.jpg", "*_left.*"), std::nullopt);
  EXPECT_EQ(match_pattern("left_.png", "left_*.png"), std::nullopt);
}

StereoCalibration plain_calibration() {
  StereoCalibration c;
  c.width_px = 64;
  c.height_px = 48;
  c.left = {{60.0, 0.0, 32.0, 0.0, 60.0, 24.0, 0.0, 0.0, 1.0}, {0.0, 0.0, 0.0, 0.0, 0.0}};
  c.right = c.left;
  c.translation_m = {-0.1, 0.0, 0.0};
  c.reprojection_px = 0.25;
  return c;
}

TEST(StereoCalibration, ComesBackFromItsFile) {
  StereoCalibration c = plain_calibration();
  c.left.distortion = {-0.3, 0.1, 0.001, -0.002, 0.0};
  const auto again = parse_stereo_calibration(to_yaml(c));
  ASSERT_TRUE(again) << again.error().message;
  EXPECT_EQ(*again, c);
}

TEST(StereoCalibration, RefusesWhatIsNone) {
  EXPECT_EQ(parse_stereo_calibration("").error().code, Errc::kParse);
  EXPECT_EQ(parse_stereo_calibration("name: x\n").error().code, Errc::kParse);
  EXPECT_EQ(parse_stereo_calibration("%YAML:1.0\n---\nimage_width: 10\n").error().code, Errc::kParse);
  const std::string whole = to_yaml(plain_calibration());
  EXPECT_FALSE(parse_stereo_calibration(whole.substr(0, whole.size() / 2)));
  StereoCalibration swapped = plain_calibration();
  swapped.translation_m[0] = 0.1;
  const Status refused = validate(swapped);
  EXPECT_EQ(refused.error().code, Errc::kInvalidArgument);
  EXPECT_NE(refused.error().message.find("exchange"), std::string::npos);
  StereoCalibration bent = plain_calibration();
  bent.rotation[0] = 0.5;
  EXPECT_FALSE(validate(bent));
  StereoCalibration blind = plain_calibration();
  blind.left.matrix[0] = std::nan("");
  EXPECT_FALSE(validate(blind));
  EXPECT_EQ(read_stereo_calibration("/nowhere/at-all.yaml").error().code, Errc::kNotFound);
}

TEST(Rectifier, LeavesPicturesOfAnIdealCameraAsTheyAre) {
  const auto rectifier = Rectifier::create(plain_calibration());
  ASSERT_TRUE(rectifier) << rectifier.error().message;
  EXPECT_NEAR(rectifier->geometry().focal_px, 60.0, 1e-6);
  EXPECT_NEAR(rectifier->geometry().baseline_m, 0.1, 1e-9);
  Image picture(64, 48, 1);
  for (std::size_t i = 0; i < picture.data().size(); ++i) {
    picture.data()[i] = static_cast<std::uint8_t>(i % 251);
  }
  const auto frame = rectifier->rectify(robot_time_s(2.0), picture, picture);
  ASSERT_TRUE(frame) << frame.error().message;
  for (int v = 1; v < 47; ++v) {
    for (int u = 1; u < 63; ++u) {
      ASSERT_NEAR(*frame->left.at(u, v), *picture.at(u, v), 1);
      ASSERT_NEAR(*frame->right.at(u, v), *picture.at(u, v), 1);
    }
  }
  EXPECT_EQ(rectifier->rectify({}, Image(64, 47, 1), picture).error().code, Errc::kInvalidArgument);
}

}  // namespace
}  // namespace seeker::drivers
