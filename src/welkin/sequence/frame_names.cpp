#include "welkin/sequence/frame_names.h"

#include <algorithm>
#include <cctype>
#include <optional>
#include <set>
#include <system_error>
#include <utility>

#include "welkin/base/error.h"
#include "welkin/map_file/face_names.h"

namespace welkin {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostDigits = 9;

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

/// A place for a number in a file's name.
struct Place {
  std::size_t at = 0, length = 0;
  int digits = 1;
};

/// The place that begins at `at`, if there is one.
std::optional<Place> place_at(const std::string& name, std::size_t at) {
  if (name[at] == '#') {
    const std::size_t length = std::min(name.find_first_not_of('#', at), name.size()) - at;
    if (length < 2 || length > kMostDigits) return std::nullopt;
    return Place{at, length, static_cast<int>(length)};
  }
  if (name[at] != '%') return std::nullopt;
  if (name.compare(at, 2, "%d") == 0) return Place{at, 2, 1};
  // %04d, and %4d, which would fill up with spaces: nobody means that.
  const std::size_t digit = name.compare(at, 2, "%0") == 0 ? at + 2 : at + 1;
  if (digit + 1 >= name.size() || !is_digit(name[digit]) || name[digit] == '0' || name[digit + 1] != 'd')
    return std::nullopt;
  return Place{at, digit + 2 - at, name[digit] - '0'};
}

std::vector<Place> places_in(const std::string& name) {
  std::vector<Place> places;
  for (std::size_t at = 0; at < name.size();) {
    const std::optional<Place> place = place_at(name, at);
    if (place) {
      places.push_back(*place);
      at += place->length;
    } else {
      // A run of # is one place or none.
      at = name[at] == '#' ? std::min(name.find_first_not_of('#', at), name.size()) : at + 1;
    }
  }
  return places;
}

/// What a `%s` can stand for: a face of a cube by any name, or a chart by its number.
bool is_face(const std::string& text) {
  static const std::set<std::string> names = [] {
    std::set<std::string> all;
    for (const map_file::FaceNames& set : map_file::known_face_names())
      all.insert(set.faces.begin(), set.faces.end());
    return all;
  }();
  return !text.empty() && (names.count(text) > 0 || std::all_of(text.begin(), text.end(), is_digit));
}

/// Whether a text is what a part of a name can be.
bool matches(const std::string& text, const std::string& part) {
  const std::size_t face = part.find("%s");
  if (face == std::string::npos) return text == part;
  const std::string left = part.substr(0, face), right = part.substr(face + 2);
  return text.size() > left.size() + right.size() && text.starts_with(left) && text.ends_with(right) &&
         is_face(text.substr(left.size(), text.size() - left.size() - right.size()));
}

std::string number_of(int frame, int digits) {
  const std::string text = std::to_string(frame);
  const std::size_t width = static_cast<std::size_t>(digits);
  return std::string(width - std::min(width, text.size()), '0') + text;
}

}  // namespace

bool FrameNames::has_place(const fs::path& name) {
  return !places_in(name.filename().string()).empty();
}

FrameNames::FrameNames(fs::path name) : name_(std::move(name)) {
  const std::string text = name_.filename().string();
  const std::vector<Place> places = places_in(text);
  if (places.empty())
    throw Error(ErrorKind::bad_request, name_.string(), "has no place for a frame's number: %04d, or ####");
  if (places.size() > 1)
    throw Error(ErrorKind::bad_request, name_.string(), "has two places for a frame's number");
  const Place place = places.front();
  before_ = text.substr(0, place.at);
  place_ = text.substr(place.at, place.length);
  after_ = text.substr(place.at + place.length);
  digits_ = place.digits;
}

fs::path FrameNames::file(int frame) const {
  require(frame >= 0 && frame <= kLargest, "a frame's number is 0 to 999999999");
  return name_.parent_path() / (before_ + number_of(frame, digits_) + after_);
}

std::vector<int> FrameNames::find() const {
  const fs::path folder = name_.has_parent_path() ? name_.parent_path() : fs::path(".");
  const auto fail = [&](const std::error_code& error) {
    const ErrorKind kind =
        error == std::errc::no_such_file_or_directory || error == std::errc::not_a_directory
            ? ErrorKind::not_found
        : error == std::errc::permission_denied ? ErrorKind::denied
                                                : ErrorKind::system;
    throw Error(kind, name_.string(), error.message());
  };
  std::set<int> frames;
  std::error_code error;
  fs::directory_iterator entries(folder, error);
  if (error) fail(error);
  for (; entries != fs::directory_iterator(); entries.increment(error)) {
    const std::string text = entries->path().filename().string();
    for (std::size_t at = 0; at < text.size(); ++at) {
      for (std::size_t length = static_cast<std::size_t>(digits_);
           length <= kMostDigits && at + length <= text.size() && is_digit(text[at + length - 1]) &&
           std::all_of(text.data() + at, text.data() + at + length, is_digit);
           ++length) {
        const std::string number = text.substr(at, length);
        const int frame = std::stoi(number);
        if (number == number_of(frame, digits_) && matches(text.substr(0, at), before_) &&
            matches(text.substr(at + length), after_))
          frames.insert(frame);
      }
    }
    if (error) fail(error);
  }
  if (error) fail(error);
  if (frames.empty())
    throw Error(ErrorKind::not_found, name_.string(), "no file is called so, with a number for " + place_);
  return {frames.begin(), frames.end()};
}

std::string frames_text(std::span<const int> frames, int most) {
  std::string text;
  for (std::size_t i = 0; i < frames.size();) {
    std::size_t end = i + 1;
    while (end < frames.size() && frames[end] == frames[end - 1] + 1) ++end;
    if (!text.empty()) text += ", ";
    if (most-- == 0) return text + "…";
    text += std::to_string(frames[i]);
    if (end - i > 1) text += "–" + std::to_string(frames[end - 1]);
    i = end;
  }
  return text;
}

FrameRange frame_range_from(std::string_view text) {
  const std::size_t dash = text.find('-');
  const auto number = [&](std::string_view part) {
    if (part.empty() || part.size() > kMostDigits || !std::all_of(part.begin(), part.end(), is_digit))
      throw Error(ErrorKind::bad_request,
                  "'" + std::string(text) + "' is no range of frames: write 1-300, or 7 for one");
    return std::stoi(std::string(part));
  };
  const int first = number(text.substr(0, dash));
  const int last = dash == std::string_view::npos ? first : number(text.substr(dash + 1));
  if (last < first)
    throw Error(ErrorKind::bad_request, "'" + std::string(text) + "' goes down: write the lower frame first");
  return {first, last};
}

}  // namespace welkin
