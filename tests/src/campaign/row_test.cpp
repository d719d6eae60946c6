// What is written into a campaign's table comes back as it was.
#include "src/campaign/row.hpp"

#include <gtest/gtest.h>

#include "src/campaign/span.hpp"

namespace hogline::campaign {
namespace {

Row full_row() {
  Row row;
  row.number = 17;
  row.seed = 576460752303423487ULL;
  row.speed_mps = 2.09;
  row.heading_deg = -1.0 / 3.0;
  row.spin_radps = -1.5;
  row.released = true;
  row.place_error_mm = 1.0 / 7.0;
  row.rest_x_m = -0.0;
  row.stop_hog_distance_m = 1e-17;
  row.abort = "device: jaws: \"no answer\", twice";
  return row;
}

TEST(Row, survives_writing_and_reading_to_the_last_bit) {
  const Row row = full_row();
  const auto back = parse_row(line_of(row));
  ASSERT_TRUE(back);
  EXPECT_EQ(line_of(*back), line_of(row));
  EXPECT_EQ(back->seed, row.seed);
  EXPECT_EQ(back->heading_deg, row.heading_deg);
  EXPECT_EQ(back->place_error_mm, row.place_error_mm);
  EXPECT_FALSE(back->speed_error_mmps);
  EXPECT_EQ(back->abort, row.abort);
}

TEST(Row, has_as_many_words_as_the_header_and_one_line) {
  Row row = full_row();
  row.abort = "two\nlines";
  const std::string line = line_of(row);
  EXPECT_EQ(line.find('\n'), std::string::npos);
  EXPECT_EQ(std::ranges::count(line, ','), std::ranges::count(header(), ','));
}

TEST(Row, anything_but_a_whole_row_is_refused) {
  const std::string line = line_of(full_row());
  EXPECT_FALSE(parse_row(""));
  EXPECT_FALSE(parse_row(header()));
  EXPECT_FALSE(parse_row(line + ","));
  EXPECT_FALSE(parse_row(line.substr(0, line.size() / 2)));
  EXPECT_FALSE(parse_row("x" + line));
}

struct Words {
  const char* text;
  bool fine;
};

TEST(Span, is_a_number_or_two_in_their_order) {
  for (const auto& [text, fine] :
       {Words{"2.09", true}, Words{"-1..1", true}, Words{"1.9..2.8", true}, Words{"2..1", false}, Words{"", false},
        Words{"..", false}, Words{"1..", false}, Words{"nan", false}, Words{"1..inf", false}, Words{"1 ..2", false}}) {
    EXPECT_EQ(parse_span(text).has_value(), fine) << text;
  }
  EXPECT_EQ(to_string(*parse_span("1.9..2.8")), "1.9..2.8");
  EXPECT_EQ(to_string(*parse_span("2")), "2");
}

}  // namespace
}  // namespace hogline::campaign
