// What programs say and hear, line by line, on pipes as they come.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <string>
#include <thread>
#include <vector>

#include "src/live/input_lines.hpp"
#include "src/live/line_writer.hpp"

namespace hogline {
namespace {

struct Pipe {
  int ends[2] = {-1, -1};
  Pipe() { EXPECT_EQ(pipe(ends), 0); }
  ~Pipe() {
    close(ends[0]);
    close(ends[1]);
  }
  std::string read_all(std::size_t count) const {
    std::string all(count, '\0');
    std::size_t got = 0;
    for (ssize_t n = 1; got < count && n > 0; got += n > 0 ? static_cast<std::size_t>(n) : 0U)
      n = read(ends[0], all.data() + got, count - got);
    all.resize(got);
    return all;
  }
};

TEST(LineWriter, LosesNothingOnAPipeThatIsFullForAWhileAndDoesNotWait) {
  const Pipe pipe;
  ASSERT_EQ(fcntl(pipe.ends[1], F_SETFL, O_NONBLOCK), 0);
  const std::string line(1000, 'x');
  constexpr std::size_t lines = 300;  // more than a pipe holds
  std::string heard;
  std::jthread reader([&] { heard = pipe.read_all(lines * (line.size() + 1)); });
  LineWriter writer(pipe.ends[1]);
  for (std::size_t i = 0; i < lines; ++i) writer.post(line + "\n");
  EXPECT_TRUE(writer.flush());
  reader.join();
  EXPECT_EQ(heard.size(), lines * (line.size() + 1));
}

TEST(LineWriter, KnowsThatNobodyReads) {
  Pipe pipe;
  ASSERT_EQ(fcntl(pipe.ends[1], F_SETFL, O_NONBLOCK), 0);
  LineWriter writer(pipe.ends[1]);
  writer.post(std::string(1'000'000, 'x'));
  EXPECT_FALSE(writer.flush());
}

/// stdin is this pipe for a while.
struct Spoken {
  Pipe pipe;
  int before = dup(STDIN_FILENO);
  explicit Spoken(const std::string& words) {
    EXPECT_EQ(write(pipe.ends[1], words.data(), words.size()), static_cast<ssize_t>(words.size()));
    EXPECT_EQ(dup2(pipe.ends[0], STDIN_FILENO), STDIN_FILENO);
  }
  ~Spoken() {
    dup2(before, STDIN_FILENO);
    close(before);
  }
};

TEST(InputLines, OfOneThatIsTooLongSomethingIsLeftToBeRefused) {
  const Spoken spoken("begin\n" + std::string(10000, 'x') + "\nstop\n");
  InputLines lines;
  std::vector<std::string> heard;
  for (int i = 0; i < 100 && heard.size() < 3; ++i) {
    if (const auto line = lines.line()) heard.push_back(*line);
  }
  ASSERT_EQ(heard.size(), 3U);
  EXPECT_EQ(heard[0], "begin");
  EXPECT_NE(heard[1].find("xxx..."), std::string::npos);
  EXPECT_LT(heard[1].size(), 5000U);
  EXPECT_EQ(heard[2], "stop");
}

}  // namespace
}  // namespace hogline
