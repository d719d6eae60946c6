// hogline_compare: hogline beside what else could be used, on the same frames, in one process, on one core.
#include <gsl/gsl_errno.h>
#include <omp.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <exception>
#include <opencv2/core/utility.hpp>
#include <string>
#include <vector>

#include "tests/bench/comparison.hpp"
#include "tests/bench/report.hpp"

namespace hogline::bench {
namespace {

struct Options {
  std::vector<std::string> scenes{HOGLINE_TEST_DATA "/near", HOGLINE_TEST_DATA "/skip"};
  std::vector<std::string> low_scenes{HOGLINE_TEST_DATA "/low"};
  std::string write_to;
  std::vector<std::string> only;
  bool smoke = false;
  bool every_frame = false;
  int passes = 3;
};

void say_every_frame(const std::vector<Column>& columns) {
  for (const Column& column : columns) {
    for (const Outcome& o : column.outcomes) {
      std::fprintf(stderr, "%-10s %-22s %7.2f ms  yaw %9.5f deg  x %7.2f  y %7.2f mm  %s\n",
                   column.contestant.key.c_str(), o.footage.c_str(), 1e3 * o.time_s, o.error.yaw_rad * 57.29577951,
                   1e3 * o.error.x_m, 1e3 * o.error.y_m, o.reason.c_str());
    }
  }
}

std::string section(const std::string& title, const std::vector<Contestant>& contestants,
                    const std::vector<Footage>& footage, const Options& options) {
  std::vector<Column> columns = compare(contestants, footage);
  for (int pass = 1; pass < options.passes; ++pass) keep_shorter_times(columns, compare(contestants, footage));
  if (options.every_frame) say_every_frame(columns);
  std::string text = "### " + title + "\n\n" + table_of(columns) + "\n";
  text += ratio_of(columns, "track", "model");
  text += ratio_of(columns, "acquire", "chain");
  text += ratio_of(columns, "track", "lines");
  return text + "\n";
}

// One scene, a few frames of the turn, every method: that it runs, not how well.
int smoke() {
  int unseen = 0;
  const auto count = [&unseen](const std::vector<Column>& columns) {
    for (const Column& column : columns) {
      const Summary s = summary_of(column);
      std::printf("%s: %d of %d frames seen\n", column.contestant.key.c_str(), s.frames - s.lost, s.frames);
      if (s.lost == s.frames) ++unseen;
    }
  };
  count(compare(near_contestants(), {scenes_in(HOGLINE_TEST_DATA "/skip").front(), first_frames(turning(false), 3)}));
  count(compare(low_contestants(), {first_frames(running(false), 3)}));
  return unseen == 0 ? 0 : 1;
}

int run(const Options& options) {
  if (options.smoke) return smoke();
  const auto scenes_of = [](const std::vector<std::string>& folders) {
    std::vector<Footage> scenes;
    for (const std::string& folder : folders) {
      for (Footage& f : scenes_in(folder)) scenes.push_back(std::move(f));
    }
    return scenes;
  };
  auto contestants = near_contestants();
  auto low = low_contestants();
  for (auto* all : {&contestants, &low}) {
    if (options.only.empty()) break;
    std::erase_if(*all, [&](const Contestant& c) {
      return std::find(options.only.begin(), options.only.end(), c.key) == options.only.end();
    });
  }
  std::string text = "Measured on " + where_and_when() + ".\n\n";
  text += section("Near view, turning", contestants, {turning(false)}, options);
  text += section("Near view, turning among people", contestants, {turning(true)}, options);
  text += section("Near view, scenes, standing still", contestants, scenes_of(options.scenes), options);
  text += section("Low view, running", low, {running(false)}, options);
  text += section("Low view, accelerating", low, {running(true)}, options);
  text += section("Low view, scenes, standing still", low, scenes_of(options.low_scenes), options);
  std::fputs(text.c_str(), stdout);
  if (!options.write_to.empty()) put_between_markers(options.write_to, "\n" + text);
  return 0;
}

}  // namespace
}  // namespace hogline::bench

int main(int argc, char** argv) {
  gsl_set_error_handler_off();
  cv::setNumThreads(1);
  omp_set_num_threads(1);

  hogline::bench::Options options;
  CLI::App app{"hogline beside other methods on the same frames: time and error of each, as Markdown"};
  app.add_option("--scenes", options.scenes, "folders of scenes (NAME.jpg with NAME.json) of the near camera")
      ->check(CLI::ExistingDirectory);
  app.add_option("--low-scenes", options.low_scenes, "the same of the low camera")->check(CLI::ExistingDirectory);
  app.add_option("--write", options.write_to, "also put the tables between the marks of this Markdown file")
      ->check(CLI::ExistingFile);
  app.add_option("--only", options.only, "only these methods")
      ->check(CLI::IsMember({"chain", "model", "lines", "acquire", "track"}));
  app.add_flag("--smoke", options.smoke, "only see that every method still runs");
  app.add_option("--passes", options.passes, "how often everything is done; the shortest time of each frame counts")
      ->check(CLI::Range(1, 100))
      ->capture_default_str();
  app.add_flag("--every-frame", options.every_frame, "every method's error on every frame, to stderr");
  CLI11_PARSE(app, argc, argv);
  try {
    return hogline::bench::run(options);
  } catch (const std::exception& e) {
    std::fprintf(stderr, "hogline_compare: %s\n", e.what());
    return 2;
  }
}
