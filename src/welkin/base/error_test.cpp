#include "welkin/base/error.h"

#include <gtest/gtest.h>

namespace welkin {
namespace {

const std::vector<std::string> kColours{"red", "green", "blue", "yellow"};

TEST(UnknownName, SuggestsTheNearestOfANearMiss) {
  const std::string message = unknown_name("colour", "gren", kColours);
  EXPECT_EQ(message, "unknown colour 'gren'; did you mean 'green'? (one of: red, green, blue, yellow)");
}

TEST(UnknownName, SuggestsNothingWhereNothingIsNear) {
  EXPECT_EQ(unknown_name("colour", "magenta", kColours).find("did you mean"), std::string::npos);
  EXPECT_EQ(unknown_name("colour", "x", {}), "unknown colour 'x' (one of:)");
}

}  // namespace
}  // namespace welkin
