#include "welkin/harmonics/coefficients_file.h"

#include <gtest/gtest.h>

#include <random>

#include "welkin/base/error.h"
#include "welkin/harmonics/harmonics_cases.h"

namespace welkin::harmonics {
namespace {

using cases::random_harmonics;

CoefficientsFile file_of(const SphericalHarmonics& f, const std::string& basis) {
  const Basis& b = basis_from_name(basis);
  return {to_basis(f, b, world_of(b)), "radiance", b.convention};
}

TEST(CoefficientsFile, ReadsBackWhatItWrites) {
  std::mt19937 random(1);
  for (const Basis& basis : bases()) {
    for (const int degree : {0, 2, 7}) {
      if (degree != 2 && basis.degree == 2) continue;
      const SphericalHarmonics f = random_harmonics(degree, degree == 7 ? 1 : 3, random);
      const CoefficientsFile file = file_of(f, basis.name);
      for (const CoefficientsFormat format : {CoefficientsFormat::json, CoefficientsFormat::csv}) {
        const CoefficientsFile back = parse_coefficients(coefficients_text(file, format), "a");
        EXPECT_EQ(back.coefficients.values, file.coefficients.values) << basis.name;
        EXPECT_EQ(back.coefficients.basis, basis.name);
        EXPECT_EQ(back.coefficients.degree, file.coefficients.degree);
        EXPECT_EQ(back.coefficients.channel_names, file.coefficients.channel_names);
        EXPECT_EQ(back.convention, file.convention);
        EXPECT_EQ(back.of, file.of);
        EXPECT_LT(cases::relative_error(harmonics_of(back), f), 1e-14);
      }
    }
  }
}

TEST(CoefficientsFile, ReadsFilamentsText) {
  std::mt19937 random(2);
  const SphericalHarmonics f = random_harmonics(2, 3, random);
  const std::string text = coefficients_text(file_of(f, "filament"), CoefficientsFormat::filament);
  EXPECT_EQ(text[0], '(');
  EXPECT_NE(text.find("); // L1-1, irradiance, pre-scaled base\n"), std::string::npos);
  EXPECT_LT(cases::relative_error(harmonics_of(parse_coefficients(text, "sh.txt")), f), 1e-13);
  // One band alone.
  const SphericalHarmonics one = harmonics_of(parse_coefficients(text.substr(0, text.find('\n')), "sh.txt"));
  EXPECT_NEAR(one.at(0, 0, 1), f.at(0, 0, 1), 1e-13);
  EXPECT_EQ(one.at(2, 1, 1), 0);
  EXPECT_THROW(coefficients_text(file_of(f, "unity"), CoefficientsFormat::filament), Error);
}

TEST(CoefficientsFile, WritesHeadersWithFloats) {
  SphericalHarmonics f(2, 3);
  f.at(0, 0, 0) = 1;
  f.at(1, -1, 1) = -2.5e-12;
  const std::string plain = coefficients_text(file_of(f, "orthonormal"), CoefficientsFormat::c_header);
  EXPECT_NE(plain.find("static const float kSh[9][3] = {\n    {1.0f, 0.0f, 0.0f}, /* L0,0 */\n    {0.0f, "
                       "-2.5e-12f, 0.0f},"),
            std::string::npos)
      << plain;
  EXPECT_EQ(plain.find("kShPacked"), std::string::npos);
  EXPECT_NE(coefficients_text(file_of(f, "unreal"), CoefficientsFormat::c_header).find("kShPacked[7][4]"),
            std::string::npos);
}

TEST(CoefficientsFile, TakesTheLeastThatSaysWhatItIs) {
  const CoefficientsFile file =
      parse_coefficients(R"({"coefficients": [[1, 2, 3]], "other": {"a": [null, true, "x\"y"]}})", "a.json");
  EXPECT_EQ(file.coefficients.degree, 0);
  EXPECT_EQ(file.coefficients.basis, "orthonormal");
  EXPECT_EQ(file.coefficients.channel_names, (std::vector<std::string>{"R", "G", "B"}));
  EXPECT_EQ(parse_coefficients("l,m,Y\n0,0,1\n", "a.csv").coefficients.channel_names,
            std::vector<std::string>{"Y"});
}

struct Bad {
  const char* text;
  ErrorKind kind;
  const char* message;
};

TEST(CoefficientsFile, SaysWhatIsWrong) {
  const Bad bad[] = {
      {"", ErrorKind::damaged, "no coefficients"},
      {"hello", ErrorKind::damaged, "line 1"},
      {"l,m,R\n0,0,1\n1,0,1\n", ErrorKind::damaged, "line 3"},
      {"l,m,R\n0,0,1\n1,-1,x\n", ErrorKind::damaged, "no number"},
      {"l,m,R\n0,0,1\n1,-1,2\n", ErrorKind::mismatch, "2 coefficients"},
      {"l,m,R\n0,0,1,2\n", ErrorKind::damaged, "head"},
      {"(1, 2); // L00", ErrorKind::damaged, "line 1"},
      {"(1, 2, 3); // L00\n(1, 2, 3); // L1-1", ErrorKind::mismatch, "2 coefficients"},
      {"{", ErrorKind::damaged, "ends early"},
      {"{}", ErrorKind::damaged, "`coefficients`"},
      {R"({"coefficients": []})", ErrorKind::damaged, "`coefficients`"},
      {R"({"coefficients": [[1],[2,3]]})", ErrorKind::damaged, "as many"},
      {R"({"coefficients": [["a"]]})", ErrorKind::damaged, "no number"},
      {R"({"coefficients": [[1e999]]})", ErrorKind::damaged, "no value"},
      {R"({"coefficients": [[NaN]]})", ErrorKind::damaged, "no value"},
      {R"({"coefficients": [[1],[2]]})", ErrorKind::mismatch, "2 coefficients"},
      {R"({"order": 2, "coefficients": [[1]]})", ErrorKind::mismatch, "order 2 has 9"},
      {R"({"order": -1, "coefficients": [[1]]})", ErrorKind::damaged, "order"},
      {R"({"order": 1e9, "coefficients": [[1]]})", ErrorKind::too_large, "over 96"},
      {R"({"basis": "unity", "coefficients": [[1]]})", ErrorKind::mismatch, "unity has 9"},
      {R"({"basis": "unitie", "coefficients": [[1]]})", ErrorKind::bad_request, "unity"},
      {R"({"convention": "mars", "coefficients": [[1]]})", ErrorKind::bad_request, "mars"},
      {R"({"of": "a\nb", "coefficients": [[1]]})", ErrorKind::damaged, "backslashes"},
      {"l,m,\"R\"\n0,0,1\n", ErrorKind::damaged, "quotes"},
      {R"({"coefficients": [[1]]} x)", ErrorKind::damaged, "goes on"},
  };
  for (const Bad& each : bad) {
    try {
      parse_coefficients(each.text, "light.json");
      ADD_FAILURE() << each.text;
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), each.kind) << each.text << ": " << error.what();
      EXPECT_NE(std::string(error.what()).find(each.message), std::string::npos) << error.what();
      EXPECT_EQ(error.file(), "light.json");
    }
  }
  const std::string deep(100000, '[');
  EXPECT_THROW(parse_coefficients("{\"a\": " + deep, "deep.json"), Error);
  EXPECT_THROW(read_coefficients("/nonexistent.json"), Error);
}

}  // namespace
}  // namespace welkin::harmonics
