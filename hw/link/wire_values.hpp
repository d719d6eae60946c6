// The values that all messages share, between plain structs and the wire's C structs.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>

#include "hogline_msgs.h"
#include "hw/team_messages.hpp"

namespace hogline::hw::link {

/// Longer texts and lists are nobody's: they are neither sent nor accepted.
inline constexpr std::size_t longest_name = 64;
inline constexpr std::size_t longest_text = 1024;
inline constexpr std::size_t most_stones = 64;
inline constexpr std::size_t most_echoes = 16;

/// Seconds and nanoseconds since 1970, as builtin_interfaces/Time. Precondition: 1970 to 2038.
builtin_interfaces_msg_dds__Time_ wire_time(TeamTime time);
/// Empty: before 1970, or more nanoseconds than a second has.
std::optional<TeamTime> plain_time(const builtin_interfaces_msg_dds__Time_& time);

/// Points into `text`, which must outlive it. The wire's structs are C's: dds_write does not change what it writes.
char* wire_text(const std::string& text);
/// Empty: no text, or longer than `longest`.
std::optional<std::string> plain_text(const char* text, std::size_t longest);

std_msgs_msg_dds__Header_ wire_header(const Origin& origin, const char* frame);
hogline_msgs_msg_dds__Origin_ wire_origin(const Origin& origin);
/// Empty: no name, session or serial 0, or a stamp that is none.
std::optional<Origin> plain_origin(const hogline_msgs_msg_dds__Origin_& origin,
                                   const builtin_interfaces_msg_dds__Time_& stamp);

/// xx, xy and yy of x and y, as a ROS 2 covariance of six: the rest is zero.
void put_covariance(double (&wire)[36], const std::array<double, 3>& covariance);
std::array<double, 3> covariance_of(const double (&wire)[36]);

bool all_finite(std::initializer_list<double> values);
bool all_finite(std::span<const double> values);

}  // namespace hogline::hw::link
