#include "tests/bench/link/host.hpp"

#include <iostream>
#include <string>

#include "common/files/files.hpp"
#include "tests/bench/link/traffic.hpp"

namespace seeker::link_bench {
namespace {

Status serve(const HostOptions& options, const MakeHost& make) {
  Latencies acts;
  Result<std::unique_ptr<Host>> host = make(options, acts);
  if (!host) {
    return tl::unexpected<Error>(host.error());
  }
  {
    const Traffic traffic([&](api::Topic topic, RobotTime stamp, const api::Payload& payload) {
      (*host)->publish(topic, stamp, payload);
    });
    if (Status written = files::write_file(options.port_file, std::to_string((*host)->port()) + "\n"); !written) {
      return written;
    }
    wait_for_end();
  }
  host->reset();
  return acts.write(options.acts);
}

}  // namespace

int run_host(int argc, char** argv, const MakeHost& make) {
  const HostOptions options = read_host_options(argc, argv);
  hold_back_end();
  const Status served = serve(options, make);
  if (!served) {
    std::cerr << argv[0] << ": " << served.error().message << '\n';
    return 1;
  }
  return 0;
}

}  // namespace seeker::link_bench
