// The robot of `./run bench link` behind gRPC: the callback interface, mutual TLS, each update encoded once for all.
#include <array>
#include <fstream>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <string>

#include <grpcpp/grpcpp.h>

#include "common/pki/bundle.hpp"
#include "common/wire/convert.hpp"
#include "common/wire/envelope.hpp"
#include "link_bench.grpc.pb.h"
#include "tests/bench/link/host.hpp"
#include "tests/bench/link/pem_bundle.hpp"

namespace seeker::link_bench {
namespace {

namespace pb = ::seeker::v1;
using Newest = std::array<std::optional<grpc::ByteBuffer>, api::kTopicCount>;

std::size_t index_of(api::Topic topic) { return static_cast<std::size_t>(topic); }

class Stream;

/// The streams that there are, and what a new one gets first.
class Streams {
 public:
  void add(const std::shared_ptr<Stream>& stream);
  void remove(const std::shared_ptr<Stream>& stream) {
    const std::lock_guard lock(mutex_);
    streams_.erase(stream);
  }
  void publish(api::Topic topic, const grpc::ByteBuffer& update);

 private:
  std::mutex mutex_;
  std::set<std::shared_ptr<Stream>> streams_;
  Newest newest_;
};

/// One client's subscription: the newest item of each of its topics, as Seeker keeps it for slow clients.
class Stream final : public grpc::ServerWriteReactor<grpc::ByteBuffer>, public std::enable_shared_from_this<Stream> {
 public:
  Stream(Streams& streams, const pb::SubscribeRequest& request) : streams_(streams) {
    for (const pb::TopicRequest& topic : request.topics()) {
      wanted_.insert(static_cast<api::Topic>(topic.topic() - 1));
    }
  }

  void offer(api::Topic topic, const grpc::ByteBuffer& update) {
    const std::lock_guard lock(mutex_);
    if (wanted_.contains(topic)) {
      waiting_.at(index_of(topic)) = update;
      write();
    }
  }

  void OnWriteDone(bool ok) override {
    const std::lock_guard lock(mutex_);
    busy_ = false;
    ok ? write() : finish();
  }
  void OnCancel() override {
    const std::lock_guard lock(mutex_);
    finish();
  }
  void OnDone() override { streams_.remove(shared_from_this()); }

 private:
  void write() {
    for (std::optional<grpc::ByteBuffer>& item : waiting_) {
      if (item && !busy_ && !finished_) {
        busy_ = true;
        writing_.Swap(&*item);
        item.reset();
        StartWrite(&writing_);
      }
    }
  }
  void finish() {
    if (!std::exchange(finished_, true)) {
      Finish(grpc::Status::CANCELLED);
    }
  }

  Streams& streams_;
  std::set<api::Topic> wanted_;
  /// Recursive: StartWrite() may report the end of the write before it returns.
  std::recursive_mutex mutex_;
  Newest waiting_;
  grpc::ByteBuffer writing_;
  bool busy_ = false;
  bool finished_ = false;
};

void Streams::add(const std::shared_ptr<Stream>& stream) {
  const std::lock_guard lock(mutex_);
  streams_.insert(stream);
  for (std::size_t k = 0; k < newest_.size(); ++k) {
    if (newest_.at(k)) {
      stream->offer(static_cast<api::Topic>(k), *newest_.at(k));
    }
  }
}

void Streams::publish(api::Topic topic, const grpc::ByteBuffer& update) {
  std::set<std::shared_ptr<Stream>> streams;
  {
    const std::lock_guard lock(mutex_);
    newest_.at(index_of(topic)) = update;
    streams = streams_;
  }
  for (const std::shared_ptr<Stream>& stream : streams) {
    stream->offer(topic, update);
  }
}

using Base = LinkBench::WithRawCallbackMethod_Subscribe<LinkBench::WithCallbackMethod_Drive<LinkBench::Service>>;

class Service final : public Base {
 public:
  Service(Streams& streams, Latencies& acts) : streams_(streams), acts_(acts) {}

  grpc::ServerWriteReactor<grpc::ByteBuffer>* Subscribe(grpc::CallbackServerContext* /*context*/,
                                                        const grpc::ByteBuffer* bytes) override {
    pb::SubscribeRequest request;
    grpc::ByteBuffer copy(*bytes);
    const bool parsed = grpc::SerializationTraits<pb::SubscribeRequest>::Deserialize(&copy, &request).ok();
    const auto stream = std::make_shared<Stream>(streams_, parsed ? request : pb::SubscribeRequest());
    streams_.add(stream);
    return stream.get();
  }

  grpc::ServerUnaryReactor* Drive(grpc::CallbackServerContext* context, const pb::DriveRequest* request,
                                  pb::DriveResponse* response) override {
    const auto command = wire::from_message<api::DriveCommand>(request->command());
    if (command && command->sent) {
      acts_.add(now() - *command->sent);
    }
    response->set_status(command ? pb::DriveResponse::STATUS_OK : pb::DriveResponse::STATUS_INVALID_ARGUMENT);
    grpc::ServerUnaryReactor* reactor = context->DefaultReactor();
    reactor->Finish(grpc::Status::OK);
    return reactor;
  }

 private:
  Streams& streams_;
  Latencies& acts_;
};

Result<std::shared_ptr<grpc::ServerCredentials>> credentials(const pki::BundleFiles& files) {
  const Result<PemBundle> own = read_bundle(files);
  if (!own) {
    return tl::unexpected<Error>(own.error());
  }
  grpc::SslServerCredentialsOptions options(GRPC_SSL_REQUEST_AND_REQUIRE_CLIENT_CERTIFICATE_AND_VERIFY);
  options.pem_root_certs = own->ca;
  options.pem_key_cert_pairs.push_back({own->key, own->certificate});
  return grpc::SslServerCredentials(options);
}

class GrpcHost final : public Host {
 public:
  explicit GrpcHost(Latencies& acts) : service_(streams_, acts) {}
  ~GrpcHost() override {
    if (server_) {
      server_->Shutdown(std::chrono::system_clock::now());
    }
  }

  Status start(const std::shared_ptr<grpc::ServerCredentials>& own) {
    grpc::ServerBuilder builder;
    builder.AddListeningPort("127.0.0.1:0", own, &port_);
    builder.RegisterService(&service_);
    server_ = builder.BuildAndStart();
    return server_ ? Status() : Status(fail(Errc::kIo, "the server of gRPC did not start"));
  }
  [[nodiscard]] std::uint16_t port() const override { return static_cast<std::uint16_t>(port_); }
  void publish(api::Topic topic, RobotTime stamp, const api::Payload& payload) override {
    const wire::SharedBody body = wire::encode_body({topic, ++sequence_, 0, stamp, payload});
    const grpc::Slice slice(*body);
    streams_.publish(topic, grpc::ByteBuffer(&slice, 1));
  }

 private:
  Streams streams_;
  Service service_;
  std::unique_ptr<grpc::Server> server_;
  int port_ = 0;
  std::uint64_t sequence_ = 0;
};

Result<std::unique_ptr<Host>> make(const HostOptions& options, Latencies& acts) {
  const auto own = credentials(pki::bundle_in(options.bundle));
  if (!own) {
    return tl::unexpected<Error>(own.error());
  }
  auto host = std::make_unique<GrpcHost>(acts);
  if (const Status started = host->start(*own); !started) {
    return tl::unexpected<Error>(started.error());
  }
  return std::unique_ptr<Host>(std::move(host));
}

}  // namespace
}  // namespace seeker::link_bench

int main(int argc, char** argv) { return seeker::link_bench::run_host(argc, argv, seeker::link_bench::make); }
