#include "hw/link/wire_values.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace hogline::hw::link {
namespace {

constexpr std::int64_t second_ns = 1'000'000'000;

// Rows and columns of x and y in a ROS 2 covariance of six.
constexpr std::size_t xx = 0;
constexpr std::size_t xy = 1;
constexpr std::size_t yx = 6;
constexpr std::size_t yy = 7;

}  // namespace

builtin_interfaces_msg_dds__Time_ wire_time(TeamTime time) {
  const std::int64_t since_1970_ns = time.time_since_epoch().count();
  return {.sec = static_cast<std::int32_t>(since_1970_ns / second_ns),
          .nanosec = static_cast<std::uint32_t>(since_1970_ns % second_ns)};
}

std::optional<TeamTime> plain_time(const builtin_interfaces_msg_dds__Time_& time) {
  if (time.sec < 0 || time.nanosec >= second_ns) return std::nullopt;
  return TeamTime{Duration{time.sec * second_ns + time.nanosec}};
}

char* wire_text(const std::string& text) { return const_cast<char*>(text.c_str()); }

std::optional<std::string> plain_text(const char* text, std::size_t longest) {
  if (text == nullptr) return std::nullopt;
  const std::size_t length = strnlen(text, longest + 1);
  if (length > longest) return std::nullopt;
  return std::string(text, length);
}

std_msgs_msg_dds__Header_ wire_header(const Origin& origin, const char* frame) {
  return {.stamp = wire_time(origin.stamp), .frame_id = const_cast<char*>(frame)};
}

hogline_msgs_msg_dds__Origin_ wire_origin(const Origin& origin) {
  return {.robot = wire_text(origin.robot), .session = origin.session, .serial = origin.serial};
}

std::optional<Origin> plain_origin(const hogline_msgs_msg_dds__Origin_& origin,
                                   const builtin_interfaces_msg_dds__Time_& stamp) {
  const auto robot = plain_text(origin.robot, longest_name);
  const auto time = plain_time(stamp);
  if (!robot || robot->empty() || !time || origin.session == 0 || origin.serial == 0) return std::nullopt;
  return Origin{.robot = *robot, .session = origin.session, .serial = origin.serial, .stamp = *time};
}

void put_covariance(double (&wire)[36], const std::array<double, 3>& covariance) {
  wire[xx] = covariance[0];
  wire[xy] = wire[yx] = covariance[1];
  wire[yy] = covariance[2];
}

std::array<double, 3> covariance_of(const double (&wire)[36]) { return {wire[xx], wire[xy], wire[yy]}; }

bool all_finite(std::span<const double> values) {
  return std::all_of(values.begin(), values.end(), [](double value) { return std::isfinite(value); });
}

bool all_finite(std::initializer_list<double> values) {
  return all_finite(std::span<const double>(values.begin(), values.size()));
}

}  // namespace hogline::hw::link
