// A fault on the command line is a known kind and a time, or nothing.
#include "src/throwing/fault.hpp"

#include <gtest/gtest.h>

namespace hogline {
namespace {

TEST(Fault, every_kind_is_understood_by_its_name) {
  for (std::size_t i = 0; i < fault_names().size(); ++i) {
    const auto fault = parse_fault(fault_names()[i] + "@1.5");
    ASSERT_TRUE(fault) << fault_names()[i];
    EXPECT_EQ(static_cast<std::size_t>(fault->kind), i);
    EXPECT_DOUBLE_EQ(fault->run_time_s, 1.5);
  }
}

TEST(Fault, anything_else_is_refused) {
  for (const char* text : {"", "@", "modbus-stop", "modbus-stop@", "@1", "modbus-stop@-1", "modbus-stop@nan",
                           "modbus-stop@inf", "modbus-stop@1s", "modbus_stop@1", "modbus-stop@1@2", "MODBUS-STOP@1"}) {
    EXPECT_FALSE(parse_fault(text)) << text;
  }
}

}  // namespace
}  // namespace hogline
