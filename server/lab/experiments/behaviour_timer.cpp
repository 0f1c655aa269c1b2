#include "server/lab/experiments/behaviour_timer.hpp"

#include <utility>

#include "server/lab/experiments/log_stopwatch.hpp"

namespace seeker::lab {
namespace {

class Watched final : public app::Behaviour {
 public:
  Watched(std::unique_ptr<app::Behaviour> inner, std::shared_ptr<DecisionLog> log)
      : inner_(std::move(inner)), log_(std::move(log)) {}

  app::Decision step(const app::Situation& situation) override {
    const double before_s = thread_seconds();
    app::Decision decision = inner_->step(situation);
    log_->processor_s += thread_seconds() - before_s;
    log_->decisions += decision.exploration ? 1 : 0;
    log_->phase = decision.phase;
    return decision;
  }
  std::shared_ptr<const vision::Recogniser> recogniser() const override { return inner_->recogniser(); }
  void on_recognition(const app::Recognition& recognition) override { inner_->on_recognition(recognition); }
  void map_moved(const MapMove& move) override { inner_->map_moved(move); }
  std::optional<api::MissionEnd> pending_end() const override { return inner_->pending_end(); }
  void resumed(RobotTime now) override { inner_->resumed(now); }
  std::optional<api::GridReport> grid() const override { return inner_->grid(); }
  std::vector<api::Detection> detections() const override { return inner_->detections(); }
  const Topology* topology() const override { return inner_->topology(); }
  std::optional<Point2> target_map() const override { return inner_->target_map(); }
  bool shares_exploration() const override { return inner_->shares_exploration(); }

 private:
  std::unique_ptr<app::Behaviour> inner_;
  std::shared_ptr<DecisionLog> log_;
};

}  // namespace

app::BehaviourFactory watched(app::BehaviourFactory factory, std::shared_ptr<DecisionLog> log) {
  return [factory = std::move(factory), log = std::move(log)](
             const api::MissionTask& task, const app::Situation& situation) -> Result<std::unique_ptr<app::Behaviour>> {
    Result<std::unique_ptr<app::Behaviour>> inner = factory(task, situation);
    if (!inner) {
      return inner;
    }
    return std::unique_ptr<app::Behaviour>(std::make_unique<Watched>(std::move(*inner), log));
  };
}

}  // namespace seeker::lab
