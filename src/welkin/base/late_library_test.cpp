#include "welkin/base/late_library.h"

#include <gtest/gtest.h>

#include "welkin/base/error.h"

namespace welkin {
namespace {

// A library that the tests are linked with anyhow.
constexpr const char* kFile = "libz.so.1";

TEST(LateLibrary, FindsFunctions) {
  unsigned long (*crc32)(unsigned long, const unsigned char*, unsigned) = nullptr;
  LateLibrary(kFile, "zlib1g", "packs bytes").find("crc32", crc32);
  ASSERT_NE(crc32, nullptr);
  const unsigned char text[] = {'1', '2', '3', '4', '5', '6', '7', '8', '9'};
  EXPECT_EQ(crc32(0, text, sizeof text), 0xcbf43926u);  // the check value of CRC-32
}

TEST(LateLibrary, OneThatIsMissingIsNamedWithItsPackage) {
  try {
    const LateLibrary library("libwelkin_missing.so.7", "libmissing7", "reads such files");
    FAIL() << "a library that isn't there was loaded";
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::unsupported);
    EXPECT_EQ(error.file(), "");
    const std::string text = error.what();
    EXPECT_TRUE(
        text.starts_with("the library libwelkin_missing.so.7, which reads such files, cannot be loaded"))
        << text;
    EXPECT_TRUE(text.ends_with("; on Debian it comes with the package libmissing7")) << text;
  }
}

TEST(LateLibrary, FunctionThatIsMissingIsNamed) {
  void (*function)() = nullptr;
  try {
    LateLibrary(kFile, "zlib1g", "packs bytes").find("welkin_missing", function);
    FAIL() << "a function that isn't there was found";
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::unsupported);
    EXPECT_NE(std::string(error.what()).find("libz.so.1 is of another version, without welkin_missing"),
              std::string::npos)
        << error.what();
  }
  EXPECT_EQ(function, nullptr);
}

}  // namespace
}  // namespace welkin
