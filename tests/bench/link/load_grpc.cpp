// Clients of `./run bench link` over gRPC: the callback interface, mutual TLS, a channel of its own for each.
#include <condition_variable>
#include <memory>
#include <mutex>
#include <string>
#include <utility>

#include <grpcpp/grpcpp.h>

#include "common/wire/convert.hpp"
#include "link_bench.grpc.pb.h"
#include "tests/bench/link/load.hpp"
#include "tests/bench/link/pem_bundle.hpp"

namespace seeker::link_bench {
namespace {

namespace pb = ::seeker::v1;

/// As those of rpc::ReconnectParams.
constexpr int kFirstDelay_ms = 100;
constexpr int kMaxDelay_ms = 5000;

/// Reads updates; when the stream breaks it is opened again at once, and gRPC connects again for that.
class Updates {
 public:
  Updates(LinkBench::Stub& stub, const ClientWish& wish) : stub_(stub), on_update_(wish.on_update) {
    for (const api::Topic topic : wish.topics) {
      request_.add_topics()->set_topic(static_cast<pb::Topic>(wire::wire_enum(topic)));
    }
    call_ = std::make_unique<Call>(*this);
  }
  Updates(const Updates&) = delete;
  Updates& operator=(const Updates&) = delete;
  ~Updates() {
    std::unique_lock lock(mutex_);
    closing_ = true;
    call_->cancel();
    changed_.wait(lock, [this] { return ended_; });
  }

 private:
  class Call final : public grpc::ClientReadReactor<pb::StreamUpdate> {
   public:
    explicit Call(Updates& owner) : owner_(owner) {
      context_.set_wait_for_ready(true);
      owner.stub_.async()->Subscribe(&context_, &owner.request_, this);
      StartRead(&update_);
      StartCall();
    }
    void cancel() { context_.TryCancel(); }
    void OnReadDone(bool ok) override {
      if (ok) {
        owner_.on_update_(static_cast<api::Topic>(update_.topic() - 1), RobotTime(Duration(update_.stamp_ns())));
        StartRead(&update_);
      }
    }
    void OnDone(const grpc::Status& /*status*/) override { owner_.call_ended(); }

   private:
    Updates& owner_;
    grpc::ClientContext context_;
    pb::StreamUpdate update_;
  };

  void call_ended() {
    const std::lock_guard lock(mutex_);
    // The call that reports its end lives until this returns.
    former_ = std::move(call_);
    if (closing_) {
      ended_ = true;
      changed_.notify_all();
      return;
    }
    call_ = std::make_unique<Call>(*this);
  }

  LinkBench::Stub& stub_;
  std::function<void(api::Topic, RobotTime)> on_update_;
  pb::SubscribeRequest request_;
  /// Recursive: gRPC may report the end of a call on the thread that cancels it.
  std::recursive_mutex mutex_;
  std::condition_variable_any changed_;
  bool closing_ = false;
  bool ended_ = false;
  std::unique_ptr<Call> call_;
  std::unique_ptr<Call> former_;
};

/// A command on its way.
struct Drive {
  grpc::ClientContext context;
  pb::DriveRequest request;
  pb::DriveResponse response;
};

Status outcome_of(const grpc::Status& carried, const pb::DriveResponse& response) {
  const bool obeyed = carried.ok() && response.status() == pb::DriveResponse::STATUS_OK;
  return obeyed ? Status() : Status(fail(Errc::kLinkLost, "the command was not obeyed " + carried.error_message()));
}

class GrpcClient final : public Client {
 public:
  GrpcClient(const std::shared_ptr<grpc::Channel>& channel, const ClientWish& wish)
      : stub_(LinkBench::NewStub(channel)), updates_(*stub_, wish) {}

  void drive(const api::DriveCommand& command, std::function<void(Status)> answered) override {
    const auto call = std::make_shared<Drive>();
    wire::write(command, call->request.mutable_command());
    stub_->async()->Drive(&call->context, &call->request, &call->response,
                          [call, answered = std::move(answered)](const grpc::Status& carried) {
                            answered(outcome_of(carried, call->response));
                          });
  }

 private:
  std::unique_ptr<LinkBench::Stub> stub_;
  Updates updates_;
};

Result<std::shared_ptr<grpc::ChannelCredentials>> credentials(const pki::BundleFiles& files) {
  const Result<PemBundle> own = read_bundle(files);
  if (!own) {
    return tl::unexpected<Error>(own.error());
  }
  return grpc::SslCredentials({own->ca, own->key, own->certificate});
}

Result<std::unique_ptr<Client>> connect(const ClientWish& wish) {
  const auto own = credentials(wish.bundle);
  if (!own) {
    return tl::unexpected<Error>(own.error());
  }
  grpc::ChannelArguments arguments;
  // Channels to one address would share a connection.
  arguments.SetInt(GRPC_ARG_USE_LOCAL_SUBCHANNEL_POOL, 1);
  arguments.SetInt(GRPC_ARG_INITIAL_RECONNECT_BACKOFF_MS, kFirstDelay_ms);
  arguments.SetInt(GRPC_ARG_MIN_RECONNECT_BACKOFF_MS, kFirstDelay_ms);
  arguments.SetInt(GRPC_ARG_MAX_RECONNECT_BACKOFF_MS, kMaxDelay_ms);
  const std::string target = "ipv4:127.0.0.1:" + std::to_string(wish.port);
  return std::make_unique<GrpcClient>(grpc::CreateCustomChannel(target, *own, arguments), wish);
}

}  // namespace
}  // namespace seeker::link_bench

int main(int argc, char** argv) { return seeker::link_bench::run_load(argc, argv, seeker::link_bench::connect); }
