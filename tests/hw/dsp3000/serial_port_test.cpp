// The serial port and the gyro behind it, over a pseudo terminal.
#include "hw/dsp3000/serial_port.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <termios.h>
#include <unistd.h>

#include <array>
#include <filesystem>
#include <stdexcept>

#include "tests/hw/dsp3000/gyro_bench.hpp"

namespace hogline::hw {
namespace {

// A pseudo terminal behind a link whose name stays, as /dev/serial/by-id.
class Terminal {
 public:
  Terminal() { plug_in(); }
  ~Terminal() {
    unplug();
    std::error_code gone;
    std::filesystem::remove(link_, gone);
  }
  void plug_in() {
    ours_ = posix_openpt(O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC);
    std::array<char, 128> path{};
    if (ours_ < 0 || grantpt(ours_) != 0 || unlockpt(ours_) != 0 || ptsname_r(ours_, path.data(), path.size()) != 0) {
      throw std::runtime_error("pseudo terminal");
    }
    theirs_ = ::open(path.data(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC);
    termios raw{};
    tcgetattr(theirs_, &raw);
    cfmakeraw(&raw);
    tcsetattr(theirs_, TCSANOW, &raw);
    std::filesystem::remove(link_);
    std::filesystem::create_symlink(path.data(), link_);
  }
  void unplug() {
    close(ours_);
    close(theirs_);
    ours_ = theirs_ = -1;
  }
  std::string path() const { return link_; }

  /// Returns when the bytes can be read at the other end.
  void say(const std::string& bytes) {
    if (bytes.empty()) return;
    ASSERT_EQ(::write(ours_, bytes.data(), bytes.size()), static_cast<ssize_t>(bytes.size()));
    for (int waiting = 0; waiting < static_cast<int>(bytes.size());) {
      pollfd wait{theirs_, POLLIN, 0};
      ASSERT_EQ(poll(&wait, 1, 60000), 1);
      ASSERT_EQ(ioctl(theirs_, FIONREAD, &waiting), 0);
    }
  }
  /// What the other end has written, when it has written at least so much.
  std::string hear(std::size_t least) {
    std::string heard;
    while (heard.size() < least) {
      pollfd wait{ours_, POLLIN, 0};
      std::array<char, 256> buffer{};
      if (poll(&wait, 1, 60000) != 1) break;
      const auto got = ::read(ours_, buffer.data(), buffer.size());
      if (got > 0) heard.append(buffer.data(), static_cast<std::size_t>(got));
    }
    return heard;
  }
  speed_t speed() const {
    termios settings{};
    tcgetattr(theirs_, &settings);
    return cfgetispeed(&settings);
  }

 private:
  std::filesystem::path link_ = std::filesystem::path(testing::TempDir()) / ("gyro_tty_" + std::to_string(getpid()));
  int ours_ = -1;
  int theirs_ = -1;
};

TEST(SerialPort, passes_every_byte_either_way_unchanged) {
  Terminal terminal;
  SerialPort port({.device = terminal.path(), .baud = 38400});
  ASSERT_FALSE(port.open());
  EXPECT_EQ(terminal.speed(), static_cast<speed_t>(B38400));
  EXPECT_EQ(port.read(), "") << "nothing yet, and no waiting";
  std::string all;
  for (int byte = 0; byte < 256; ++byte) all += static_cast<char>(byte);
  terminal.say(all);
  EXPECT_EQ(port.read(), all);
  EXPECT_TRUE(port.write(all));
  EXPECT_EQ(terminal.hear(all.size()), all);
}

TEST(SerialPort, throws_away_what_waits_when_it_is_opened) {
  Terminal terminal;
  SerialPort port({.device = terminal.path(), .baud = 115200});
  ASSERT_FALSE(port.open());
  terminal.say("old");
  ASSERT_FALSE(port.open());
  EXPECT_EQ(port.read(), "");
}

TEST(SerialPort, says_why_it_can_not_be_opened) {
  SerialPort absent({.device = "/dev/serial/by-id/absent", .baud = 38400});
  const auto why = absent.open();
  ASSERT_TRUE(why);
  EXPECT_NE(why->find("/dev/serial/by-id/absent"), std::string::npos);
  EXPECT_FALSE(absent.read());
  EXPECT_FALSE(absent.write("R"));
  SerialPort no_terminal({.device = "/dev/null", .baud = 38400});
  EXPECT_TRUE(no_terminal.open());
  EXPECT_THROW(SerialPort({.device = "/dev/null", .baud = 12345}), std::invalid_argument);
}

TEST(SerialPort, an_unplugged_line_is_gone_and_not_silent) {
  Terminal terminal;
  SerialPort port({.device = terminal.path(), .baud = 38400});
  ASSERT_FALSE(port.open());
  terminal.unplug();
  EXPECT_FALSE(port.read());
  terminal.plug_in();
  EXPECT_FALSE(port.read()) << "another terminal under the same name is not the one that was opened";
  ASSERT_FALSE(port.open());
  EXPECT_EQ(port.read(), "");
}

class GyroOverTerminal : public testing::TestWithParam<Dsp3000Variant> {};

TEST_P(GyroOverTerminal, is_asked_verified_lost_and_found_under_its_name) {
  Terminal terminal;
  sim::GyroDevice device(gyro_scenario(GetParam()), 3, Stamp{});
  SerialPort port({.device = terminal.path(), .baud = GetParam() == Dsp3000Variant::text ? 38400 : 115200});
  Dsp3000Gyro gyro(port, gyro_config(GetParam()));
  Stamp now{};
  bool plugged = true;
  const auto run = [&](Duration span, double rate_radps) {
    for (const Stamp end = now + span; now < end;) {
      now += 5ms;
      device.step(now, rate_radps);
      const auto bytes = device.read();
      if (plugged) terminal.say(bytes);
      gyro.step(now);
    }
  };
  gyro.step(now);
  EXPECT_EQ(terminal.hear(1), "R");
  run(1s, 5.0 * degree);
  EXPECT_TRUE(gyro.state().valid);
  EXPECT_NEAR(gyro.state().rate_radps, 5.0 * degree, 0.2 * degree);
  EXPECT_FALSE(gyro.state().error);

  terminal.unplug();
  plugged = false;
  run(20ms, 5.0 * degree);
  ASSERT_TRUE(gyro.state().error);
  EXPECT_EQ(gyro.state().error->kind, DeviceErrorKind::disconnected);
  EXPECT_FALSE(gyro.state().valid);

  terminal.plug_in();
  plugged = true;
  run(500ms, -5.0 * degree);
  EXPECT_TRUE(gyro.state().error) << "latched";
  gyro.rearm();
  run(500ms, -5.0 * degree);
  EXPECT_FALSE(gyro.state().error);
  EXPECT_NEAR(gyro.state().rate_radps, -5.0 * degree, 0.2 * degree);
  EXPECT_NE(terminal.hear(1).find('R'), std::string::npos) << "asked anew";
}

INSTANTIATE_TEST_SUITE_P(variants, GyroOverTerminal, testing::Values(Dsp3000Variant::text, Dsp3000Variant::binary),
                         [](const auto& variant) { return variant.param == Dsp3000Variant::text ? "text" : "binary"; });

}  // namespace
}  // namespace hogline::hw
