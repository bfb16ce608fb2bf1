#include "welkin/io/boxes.h"

#include "welkin/io/test_pictures.h"

namespace welkin::io::test {
namespace {

using namespace std::string_literals;

/// Type and length of each box.
std::vector<std::pair<std::string, std::size_t>> boxes_of(const std::string& text) {
  const Bytes bytes = bytes_of(text);
  const Source source{bytes, "a", {}};
  Boxes boxes(source, source.bytes);
  std::vector<std::pair<std::string, std::size_t>> found;
  while (const std::optional<Box> box = boxes.next()) {
    EXPECT_GE(box->content.data(), bytes.data());
    EXPECT_LE(box->content.data() + box->content.size(), bytes.data() + bytes.size());
    found.emplace_back(box->type, box->content.size());
  }
  return found;
}

using Found = std::vector<std::pair<std::string, std::size_t>>;

TEST(Boxes, SizesOf32And64BitsAndToTheEnd) {
  EXPECT_EQ(boxes_of(""), Found{});
  EXPECT_EQ(boxes_of("\0\0\0\x0b"s
                     "onlyabc"),
            (Found{{"only", 3}}));
  EXPECT_EQ(boxes_of("\0\0\0\x08"s
                     "none"
                     "\0\0\0\x01"s
                     "long\0\0\0\0\0\0\0\x12"s
                     "ab"
                     "\0\0\0\0"s
                     "lastabcd"),
            (Found{{"none", 0}, {"long", 2}, {"last", 4}}));
}

TEST(Boxes, ThatPassTheEndAreRefused) {
  EXPECT_EQ(error_of([] { boxes_of("\0\0\0\x08none\0\0\0"s); }),
            "a: ends early, within the header of a box (byte 8)");
  EXPECT_EQ(error_of([] { boxes_of("\0\0\0\x01long\0\0\0\0\0\0\0"s); }),
            "a: ends early, within the header of a box (byte 0)");
  EXPECT_EQ(error_of([] { boxes_of("\0\0\0\x09none"s); }), "a: ends early: a box passes the end (byte 0)");
  EXPECT_EQ(error_of([] { boxes_of("\0\0\0\x01long\xff\xff\xff\xff\xff\xff\xff\xff"s); }),
            "a: ends early: a box passes the end (byte 0)");
  EXPECT_EQ(error_of([] { boxes_of("\0\0\0\x07none"s); }), "a: a box is smaller than its header (byte 0)");
  EXPECT_EQ(error_of([] { boxes_of("\0\0\0\x01long\0\0\0\0\0\0\0\x0f"s); }),
            "a: a box is smaller than its header (byte 0)");
}

}  // namespace
}  // namespace welkin::io::test
