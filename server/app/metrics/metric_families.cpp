#include "server/app/metrics/metric_families.hpp"

#include <string>
#include <utility>

#include "common/core/time.hpp"

namespace seeker::app {
namespace {

using prometheus::ClientMetric;
using prometheus::MetricFamily;
using prometheus::MetricType;
using Labels = std::vector<ClientMetric::Label>;

/// One family under construction.
class Family {
 public:
  Family(const char* name, const char* help, MetricType type) : family_{name, help, type, {}} {}

  Family& add(double value, Labels labels = {}) {
    ClientMetric metric;
    metric.label = std::move(labels);
    (family_.type == MetricType::Counter ? metric.counter.value : metric.gauge.value) = value;
    family_.metric.push_back(std::move(metric));
    return *this;
  }
  void into(std::vector<MetricFamily>& families) { families.push_back(std::move(family_)); }

 private:
  MetricFamily family_;
};

void gauge(const char* name, const char* help, double value, std::vector<MetricFamily>& families) {
  Family(name, help, MetricType::Gauge).add(value).into(families);
}

void counter(const char* name, const char* help, std::uint64_t value, std::vector<MetricFamily>& families) {
  Family(name, help, MetricType::Counter).add(static_cast<double>(value)).into(families);
}

void add_faults(const std::vector<api::Fault>& faults, std::vector<MetricFamily>& families) {
  gauge("seeker_faults", "Number of faults that are present", static_cast<double>(faults.size()), families);
  Family present("seeker_fault", "1 for each fault that is present", MetricType::Gauge);
  for (const api::Fault& fault : faults) {
    present.add(
        1.0,
        {{"id", fault.id}, {"component", fault.component}, {"severity", std::string(api::to_string(fault.severity))}});
  }
  present.into(families);
}

void add_mission(const std::optional<api::MissionStatus>& mission, std::vector<MetricFamily>& families) {
  Family running("seeker_mission", "1 for the mission that is running or paused", MetricType::Gauge);
  if (mission && !mission->end) {
    running.add(1.0, {{"kind", mission->kind}, {"state", std::string(api::to_string(mission->state))}});
  }
  running.into(families);
}

void add_timing(const TickTiming& timing, std::vector<MetricFamily>& families) {
  counter("seeker_loop_due_ticks_total", "Ticks of the loop that the wall clock paced", timing.ticks, families);
  counter("seeker_loop_late_ticks_total", "Ticks that began more than 20 ms after they were due", timing.late,
          families);
  gauge("seeker_loop_worst_lateness_seconds", "Largest delay of a tick since the start", to_seconds(timing.worst),
        families);
}

}  // namespace

void add_status(const api::RobotStatus& status, std::vector<MetricFamily>& families) {
  gauge("seeker_armed", "1: the motors may be powered", status.motors_armed ? 1.0 : 0.0, families);
  gauge("seeker_estop", "1: the emergency stop is latched", status.estop ? 1.0 : 0.0, families);
  gauge("seeker_placed", "1: the robot knows where it is in its map", is_placed(status.pose.quality) ? 1.0 : 0.0,
        families);
  gauge("seeker_velocity_meters_per_second", "Velocity ahead", status.velocity.v_m_s, families);
  gauge("seeker_map_revision", "Revision of the occupancy map", static_cast<double>(status.map_revision), families);
  if (status.battery_v) {
    gauge("seeker_battery_volts", "Voltage of the battery", *status.battery_v, families);
  }
  if (status.timing) {
    add_timing(*status.timing, families);
  }
  add_mission(status.mission, families);
  add_faults(status.faults, families);
}

void add_network(const server_net::ServerStats& stats, std::vector<MetricFamily>& families) {
  gauge("seeker_sessions", "Connected clients", static_cast<double>(stats.sessions), families);
  counter("seeker_connections_total", "Accepted connections", stats.accepted, families);
  counter("seeker_clients_lost_total", "Clients that did not leave on purpose", stats.lost, families);
  counter("seeker_requests_refused_total", "Requests that were refused", stats.refused_requests, families);
  counter("seeker_frames_sent_total", "Frames sent to clients", stats.frames_sent, families);
  counter("seeker_sent_bytes_total", "Bytes sent to clients", stats.bytes_sent, families);
  counter("seeker_updates_encoded_total", "Stream updates, each encoded once for all clients", stats.encoded, families);
  Family dropped("seeker_updates_dropped_total", "Updates that slow clients missed", MetricType::Counter);
  for (std::size_t topic = 0; topic < stats.dropped.size(); ++topic) {
    dropped.add(static_cast<double>(stats.dropped[topic]),
                {{"topic", std::string(api::to_string(static_cast<api::Topic>(topic)))}});
  }
  dropped.into(families);
  gauge("seeker_queued_bytes", "Bytes of answers that clients have not taken yet",
        static_cast<double>(stats.queued_bytes), families);
}

}  // namespace seeker::app
