#include "hw/digital_curling/client_message.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <string>

namespace hogline::hw::digital_curling::test {
namespace {

using servo::Concession;
using servo::Curl;
using servo::GameMove;
using servo::HackShot;

template <class Kind>
Kind taken(const std::string& line, Due due) {
  const Decoded decoded = decode(line, due);
  EXPECT_TRUE(decoded.message) << decoded.problem;
  return decoded.message ? std::get<Kind>(*decoded.message) : Kind{};
}

TEST(ClientMessage, IsTakenAsTheProtocolHasIt) {
  EXPECT_EQ(taken<DcOk>(R"({"cmd":"dc_ok","name":"sample ai"})", Due::dc_ok).name, "sample ai");
  EXPECT_EQ(taken<DcOk>("{\"cmd\":\"dc_ok\",\"name\":\"\xe6\xb0\xb7\"}", Due::dc_ok).name, "\xe6\xb0\xb7") << "UTF-8";
  const std::array<int, 4> order{0, 1, 3, 2};
  EXPECT_EQ(taken<ReadyOk>(R"({"cmd":"ready_ok","player_order":[0,1,3,2]})", Due::ready_ok).player_order, order);
  const auto move = taken<GameMove>(
      " {\"move\": {\"rotation\":\"cw\",\"type\":\"shot\",\"velocity\":{\"y\":2,\"x\":-0.125}}, \"cmd\":\"move\"}\r",
      Due::move);
  const auto& shot = std::get<HackShot>(move);
  EXPECT_EQ(shot.vx_mps, -0.125);
  EXPECT_EQ(shot.vy_mps, 2.0);
  EXPECT_EQ(shot.curl, Curl::clockwise);
  EXPECT_TRUE(
      std::holds_alternative<Concession>(taken<GameMove>(R"({"cmd":"move","move":{"type":"concede"}})", Due::move)));
  EXPECT_TRUE(decode(R"({"cmd":"dc_ok","name":"a","mood":"good"})", Due::dc_ok).message) << "more than is asked for";
}

struct Wrong {
  const char* what;
  Due due;
  std::string line;
  const char* problem;  ///< begins with
};

class WrongMessages : public testing::TestWithParam<Wrong> {};

TEST_P(WrongMessages, AreRefusedWithWhatIsWrong) {
  const Decoded decoded = decode(GetParam().line, GetParam().due);
  EXPECT_FALSE(decoded.message);
  EXPECT_EQ(decoded.problem.substr(0, std::string(GetParam().problem).size()), GetParam().problem);
}

std::string shot(const std::string& velocity, const std::string& rotation = "\"cw\"") {
  return R"({"cmd":"move","move":{"type":"shot","velocity":)" + velocity + R"(,"rotation":)" + rotation + "}}";
}

INSTANTIATE_TEST_SUITE_P(
    Each, WrongMessages,
    testing::Values(
        Wrong{"nothing", Due::move, "", "it is no JSON: parse error at line 1, column 1"},
        Wrong{"cut_off", Due::move, R"({"cmd":"mo)", "it is no JSON: parse error at line 1"},
        Wrong{"two_values", Due::move, "{} {}", "it is no JSON: parse error at line 1, column 4"},
        Wrong{"a_comment", Due::dc_ok, R"({"cmd":"dc_ok" /* hi */})", "it is no JSON"},
        Wrong{"no_utf8", Due::dc_ok, "{\"cmd\":\"dc_ok\",\"name\":\"\xff\xfe\"}", "it is no JSON"},
        Wrong{"a_nul", Due::move, std::string("{\0}", 3), "it is no JSON"},
        Wrong{"an_array", Due::move, "[1,2]", "it is no object"}, Wrong{"null", Due::move, "null", "it is no object"},
        Wrong{"deep", Due::move, std::string(5000, '['), "it is nested too deeply"},
        Wrong{"deep_objects", Due::move, R"({"a":{"a":{"a":{"a":{"a":{"a":{"a":{"a":{"a":{}}}}}}}}}})",
              "it is nested too deeply"},
        Wrong{"a_key_twice", Due::move, R"({"cmd":"move","move":{"type":"concede"},"cmd":"move"})",
              "it has the key 'cmd' twice"},
        Wrong{"no_cmd", Due::move, R"({"move":{}})", "cmd is missing"},
        Wrong{"cmd_a_number", Due::move, R"({"cmd":3})", "cmd must be a string"},
        Wrong{"another_cmd", Due::move, R"({"cmd":"ready_ok"})", "cmd must be 'move' now, not 'ready_ok'"},
        Wrong{"cmd_in_other_letters", Due::move, "{\"cmd\":\"m\\u00f6ve\"}", "cmd must be 'move' now, not 'm??ve'"},
        Wrong{"no_name", Due::dc_ok, R"({"cmd":"dc_ok"})", "name is missing"},
        Wrong{"long_name", Due::dc_ok, R"({"cmd":"dc_ok","name":")" + std::string(65, 'x') + "\"}",
              "name must have at most 64 bytes"},
        Wrong{"name_with_a_line_end", Due::dc_ok, R"({"cmd":"dc_ok","name":"a\nb"})",
              "name must have no control characters"},
        Wrong{"order_of_three", Due::ready_ok, R"({"cmd":"ready_ok","player_order":[0,1,2]})", "player_order must be"},
        Wrong{"order_with_one_twice", Due::ready_ok, R"({"cmd":"ready_ok","player_order":[0,1,2,2]})",
              "player_order must be"},
        Wrong{"order_beyond", Due::ready_ok, R"({"cmd":"ready_ok","player_order":[0,1,2,4]})", "player_order must be"},
        Wrong{"order_of_fractions", Due::ready_ok, R"({"cmd":"ready_ok","player_order":[0,1,2,3.0]})",
              "player_order must be"},
        Wrong{"order_far_beyond", Due::ready_ok, R"({"cmd":"ready_ok","player_order":[0,1,2,4294967299]})",
              "player_order must be"},
        Wrong{"no_move", Due::move, R"({"cmd":"move"})", "move is missing"},
        Wrong{"move_a_string", Due::move, R"({"cmd":"move","move":"shot"})", "move must be an object"},
        Wrong{"unknown_type", Due::move, R"({"cmd":"move","move":{"type":"pass"}})",
              "move.type must be 'shot' or 'concede', not 'pass'"},
        Wrong{"concede_and_shot", Due::move, R"({"cmd":"move","move":{"type":"concede","rotation":"cw"}})",
              "move.rotation is unknown"},
        Wrong{"no_velocity", Due::move, R"({"cmd":"move","move":{"type":"shot","rotation":"cw"}})",
              "move.velocity is missing"},
        Wrong{"velocity_an_array", Due::move, shot("[0.1,2.4]"), "move.velocity must be an object"},
        Wrong{"no_y", Due::move, shot(R"({"x":0.1})"), "move.velocity.y is missing"},
        Wrong{"a_z", Due::move, shot(R"({"x":0.1,"y":2.4,"z":0})"), "move.velocity.z is unknown"},
        Wrong{"x_a_string", Due::move, shot(R"({"x":"0.1","y":2.4})"), "move.velocity.x must be a number"},
        Wrong{"x_null", Due::move, shot(R"({"x":null,"y":2.4})"), "move.velocity.x must be a number"},
        Wrong{"nan", Due::move, shot(R"({"x":NaN,"y":2.4})"), "it is no JSON"},
        Wrong{"infinity", Due::move, shot(R"({"x":Infinity,"y":2.4})"), "it is no JSON"},
        Wrong{"beyond_a_double", Due::move, shot(R"({"x":0.1,"y":1e999})"),
              "it is no JSON: number overflow parsing '1e999'"},
        Wrong{"far_too_fast", Due::move, shot(R"({"x":0.1,"y":1e300})"),
              "move.velocity.y must be between -10 and 10 m/s"},
        Wrong{"unknown_rotation", Due::move, shot(R"({"x":0.1,"y":2.4})", "\"CW\""),
              "move.rotation must be 'cw' or 'ccw', not 'CW'"},
        Wrong{"rotation_a_number", Due::move, shot(R"({"x":0.1,"y":2.4})", "1"), "move.rotation must be a string"}),
    [](const auto& wrong) { return std::string(wrong.param.what); });

RC_GTEST_PROP(ClientMessageProperty, WhateverBytesComeTheAnswerIsAMessageOrPrintableWords, ()) {
  const auto due = *rc::gen::element(Due::dc_ok, Due::ready_ok, Due::move);
  std::string line = *rc::gen::element<std::string>(R"({"cmd":"dc_ok","name":"ab"})", shot(R"({"x":0.1,"y":2.4})"),
                                                    R"({"cmd":"ready_ok","player_order":[0,1,3,2]})", "");
  const int changes = *rc::gen::inRange(0, 4);
  for (int i = 0; i < changes && !line.empty(); ++i)
    line[*rc::gen::inRange<std::size_t>(0, line.size())] = *rc::gen::arbitrary<char>();
  const Decoded decoded = decode(line, due);
  RC_ASSERT(decoded.message.has_value() == decoded.problem.empty());
  for (const char c : decoded.problem) RC_ASSERT(c >= 0x20 && c < 0x7f);
  RC_ASSERT(decoded.problem.size() < 300u);
}

}  // namespace
}  // namespace hogline::hw::digital_curling::test
