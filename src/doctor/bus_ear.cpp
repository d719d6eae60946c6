#include "src/doctor/bus_ear.hpp"

#include <utility>

namespace hogline::doctor {
namespace {

// CiA 301's predefined connection set.
constexpr std::uint32_t nmt = 0x000;
constexpr std::uint32_t sync = 0x080;
constexpr std::uint32_t node_mask = 0x07F;
constexpr std::uint32_t function_mask = 0x780;

bool is_rpdo(std::uint32_t id) {
  const std::uint32_t function = id & function_mask;
  return function == 0x200 || function == 0x300 || function == 0x400 || function == 0x500;
}

}  // namespace

std::optional<double> HeardNode::period_s() const {
  if (heartbeats < 2) return std::nullopt;
  return seconds(last - first) / (heartbeats - 1);
}

BusEar::BusEar(std::set<std::uint8_t> own_nodes, std::uint8_t master_node)
    : own_nodes_(std::move(own_nodes)), master_node_(master_node) {}

bool BusEar::is_masters(const hw::CanFrame& frame) const {
  if (frame.extended) return false;
  const auto node = static_cast<std::uint8_t>(frame.id & node_mask);
  return frame.id == nmt || frame.id == sync || (is_rpdo(frame.id) && own_nodes_.contains(node));
}

void BusEar::on_frame(const hw::StampedCanFrame& received) {
  ++frames_;
  if (is_masters(received.frame)) ++other_master_;
  const auto heartbeat = hw::decode_heartbeat(received.frame);
  if (!heartbeat) return;
  if (heartbeat->node == master_node_) ++other_master_;
  HeardNode& node = nodes_[heartbeat->node];
  if (node.heartbeats++ == 0) node.first = received.stamp;
  node.last = received.stamp;
  node.state = heartbeat->state;
}

}  // namespace hogline::doctor
