#include "welkin/brdf/table_text.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <regex>
#include <vector>

#include "welkin/base/error.h"

namespace welkin::brdf {
namespace {

Image some_table() {
  Image image(3, 2, 2);
  float value = 1.0f / 3;
  for (int y = 0; y < 2; ++y) {
    for (int i = 0; i < 6; ++i, value *= -0.017f) image.at(0, y)[i] = value;
  }
  image.at(2, 1)[1] = 1;
  return image;
}

TEST(CHeader, ReadsBackAsTheSameFloats) {
  const Image image = some_table();
  const std::string text = c_header(image.view(), "dfg_table", "first line\nsecond");
  EXPECT_EQ(text.rfind("// first line\n// second\n#ifndef DFG_TABLE_H\n", 0), 0u) << text;
  for (const char* line : {"#define DFG_TABLE_WIDTH 3\n", "#define DFG_TABLE_HEIGHT 2\n",
                           "#define DFG_TABLE_CHANNELS 2\n", "static const float dfg_table[12] = {\n"}) {
    EXPECT_NE(text.find(line), std::string::npos) << line;
  }
  const std::regex number(R"([-+0-9.e]+f,)");
  const std::string body = text.substr(text.find('{'));
  std::vector<float> values;
  for (std::sregex_iterator i(body.begin(), body.end(), number), end; i != end; ++i)
    values.push_back(std::strtof(i->str().c_str(), nullptr));
  ASSERT_EQ(values.size(), 12u);
  for (int i = 0; i < 12; ++i) EXPECT_EQ(values[static_cast<std::size_t>(i)], image.at(0, i / 6)[i % 6]);
  EXPECT_NE(text.find("1.0f,"), std::string::npos);
}

TEST(CHeader, RefusesWhatIsNoHeader) {
  Image image = some_table();
  for (const char* name : {"", "3d", "a-b", "a b", "x;int y"})
    EXPECT_THROW(c_header(image.view(), name), Error) << name;
  EXPECT_THROW(c_header({}, "empty"), Error);
  image.at(1, 1)[0] = NAN;
  EXPECT_THROW(c_header(image.view(), "nan"), Error);
}

}  // namespace
}  // namespace welkin::brdf
