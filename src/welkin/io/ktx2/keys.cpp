#include "welkin/io/ktx2/keys.h"

#include <algorithm>
#include <cstring>
#include <string_view>

#include "welkin/base/error.h"
#include "welkin/base/version.h"
#include "welkin/io/byte_order.h"

namespace welkin::io::ktx2 {
namespace {

constexpr std::size_t kAlignment = 4;

std::size_t padded(std::size_t size) {
  return (size + kAlignment - 1) / kAlignment * kAlignment;
}

bool is_text(std::string_view value) {
  return value.find('\0') == std::string_view::npos;
}

void parse_entry(std::string_view entry, std::size_t key_bytes, Keys& keys) {
  const std::string key(entry.substr(0, key_bytes));
  std::string_view value = entry.substr(key_bytes + 1);
  const std::size_t stored = value.size();
  if (!value.empty() && value.back() == '\0') value.remove_suffix(1);
  if (key == "KTXmapRange") {
    keys.warnings.push_back("KTXmapRange, a scale and an offset of all values, is not applied");
    return;
  }
  if (key != "KTXcubemapIncomplete" && key != "KTXanimData" && is_text(value)) {
    keys.texts.emplace(key, value);
  } else {
    keys.notes.push_back(key + ": " + std::to_string(stored) + " bytes that are not text");
  }
}

}  // namespace

Keys parse_keys(std::span<const std::byte> bytes, std::uint64_t offset) {
  Keys keys;
  std::size_t at = 0;
  const auto fail = [&](const std::string& cause) {
    throw Error(ErrorKind::damaged,
                "key/value data: " + cause + " (byte " + std::to_string(offset + at) + ")");
  };
  while (at < bytes.size()) {
    if (bytes.size() - at < sizeof(std::uint32_t)) fail("an entry ends early");
    const std::size_t length = load_native<std::uint32_t>(bytes.data() + at);
    if (length < 2) fail("an entry of " + std::to_string(length) + " bytes holds no key");
    if (length > bytes.size() - at - sizeof(std::uint32_t)) fail("an entry is longer than the data");
    at += sizeof(std::uint32_t);
    const std::string_view entry(reinterpret_cast<const char*>(bytes.data() + at), length);
    const std::size_t key_bytes = entry.find('\0');
    if (key_bytes == std::string_view::npos) fail("a key has no end");
    if (key_bytes == 0) fail("a key is empty");
    parse_entry(entry, key_bytes, keys);
    at += std::min(padded(length), bytes.size() - at);
  }
  return keys;
}

std::vector<std::byte> written_keys(const std::map<std::string, std::string>& attributes) {
  // The order of std::string is that of bytes, which in UTF-8 is the order of code points.
  std::map<std::string, std::string> all = {{"KTXorientation", "rd"},
                                            {"KTXwriter", "welkin " + std::string(version())}};
  for (const auto& [key, value] : attributes) {
    if (key.starts_with("KTX") || key.starts_with("ktx")) continue;
    if (key.empty()) throw Error(ErrorKind::damaged, "an attribute without a name cannot be a key of KTX2");
    for (const std::string& text : {key, value}) {
      if (!is_text(text))
        throw Error(ErrorKind::damaged, "the attribute '" + std::string(key.c_str()) +
                                            "' holds a zero byte, where its text ends");
    }
    all.emplace(key, value);
  }
  std::vector<std::byte> bytes;
  for (const auto& [key, value] : all) {
    const std::size_t length = key.size() + 1 + value.size() + 1, at = bytes.size();
    if (length > 0xffffff)
      throw Error(ErrorKind::damaged, "the attribute '" + key + "' is longer than 16 MiB");
    bytes.resize(at + sizeof(std::uint32_t) + padded(length));
    const auto word = static_cast<std::uint32_t>(length);
    std::byte* to = bytes.data() + at;
    std::memcpy(to, &word, sizeof word);
    std::memcpy(to + sizeof word, key.data(), key.size());
    std::memcpy(to + sizeof word + key.size() + 1, value.data(), value.size());
  }
  return bytes;
}

}  // namespace welkin::io::ktx2
