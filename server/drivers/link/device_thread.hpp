/// \file
/// A device's session on its line, on a thread of its own.
#pragma once

#include <chrono>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include <boost/asio/executor_work_guard.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/steady_timer.hpp>

#include "common/net/connect.hpp"
#include "server/drivers/interfaces/drivers.hpp"
#include "server/drivers/link/device_session.hpp"
#include "server/drivers/link/line.hpp"

namespace seeker::drivers {

struct DeviceThreadParams {
  LineAddress line;
  Duration open_timeout = std::chrono::seconds(3);
  /// Delays between attempts to open the line: they double from the first to the longest.
  Duration first_reopen = std::chrono::milliseconds(250);
  Duration longest_reopen = std::chrono::seconds(4);
  /// For the session's farewell when the device is closed.
  Duration farewell = std::chrono::milliseconds(300);
};

/// Opens the line, carries bytes and time to the session and its wishes to the line, and opens the line again whenever
/// it is lost. The session is used under a lock that is never held while anything waits, so that the robot's loop,
/// which commands and reads through with(), is never held up by a device.
class DeviceThread {
 public:
  /// `now` gives robot time on any thread. `name` is what the log calls the device.
  DeviceThread(std::string name, DeviceThreadParams params, std::shared_ptr<DeviceSession> session,
               std::function<RobotTime()> now);
  ~DeviceThread() { stop(); }
  DeviceThread(const DeviceThread&) = delete;
  DeviceThread& operator=(const DeviceThread&) = delete;

  /// Begins to open the line, and returns at once.
  void start();
  /// Lets the session say farewell and closes the line; waits for both, for DeviceThreadParams::farewell at most.
  void stop();

  /// Calls `use()` under the session's lock, then has the thread carry out what the session wants.
  template <class Use>
  auto with(Use use) {
    const Wake wake(*this);
    const std::lock_guard lock(mutex_);
    return use();
  }
  /// The same for what changes nothing.
  template <class Look>
  auto look(Look look) const {
    const std::lock_guard lock(mutex_);
    return look();
  }

  /// Why the device delivers nothing; success when it does.
  [[nodiscard]] Status state() const;
  [[nodiscard]] LinkStatistics statistics() const;

 private:
  /// Wakes the thread once the lock is released.
  struct Wake {
    explicit Wake(DeviceThread& thread) : owner(thread) {}
    ~Wake() { owner.wake(); }
    Wake(const Wake&) = delete;
    Wake& operator=(const Wake&) = delete;
    DeviceThread& owner;
  };

  void run();
  void wake();
  void open();
  void opened(Result<std::unique_ptr<Line>> line);
  void read();
  void lose(const Error& why);
  /// Fetches the session's wishes and begins to carry them out.
  void serve();
  void carry_out();
  [[nodiscard]] Status apply(const LineAction& action);
  void set_timer();
  void say_farewell();
  void finish_when_written();

  std::string name_;
  DeviceThreadParams params_;
  std::shared_ptr<DeviceSession> session_;
  std::function<RobotTime()> now_;

  mutable std::mutex mutex_;   ///< of the session, of lost_ and of opening_
  std::optional<Error> lost_;  ///< why there is no line
  bool running_ = false;       ///< used by the owner's thread alone

  boost::asio::io_context io_{1};  ///< what follows belongs to the device's thread
  std::thread thread_;
  boost::asio::steady_timer timer_{io_};
  boost::asio::steady_timer reopen_{io_};
  net::Backoff backoff_;
  std::unique_ptr<Line> line_;
  std::deque<LineAction> actions_;
  bool writing_ = false;
  bool closing_ = false;
};

}  // namespace seeker::drivers
