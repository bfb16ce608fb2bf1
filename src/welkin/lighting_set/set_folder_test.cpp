#include "welkin/lighting_set/set_folder.h"

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "welkin/base/error.h"

namespace welkin {
namespace {

namespace fs = std::filesystem;

class SetFolder : public testing::Test {
 protected:
  void SetUp() override {
    root_ = fs::temp_directory_path() /
            ("welkin-set-" + std::string(testing::UnitTest::GetInstance()->current_test_info()->name()) +
             "-" + std::to_string(::testing::UnitTest::GetInstance()->random_seed()) + "-" +
             std::to_string(counter_++));
    fs::remove_all(root_);
    fs::create_directory(root_);
  }
  void TearDown() override { fs::remove_all(root_); }

  static std::vector<std::string> write(const fs::path& folder,
                                        const std::vector<std::pair<std::string, std::string>>& texts) {
    std::vector<FolderFile> files;
    for (const auto& [name, text] : texts) files.push_back({name, std::as_bytes(std::span(text))});
    return write_set_folder(folder, files);
  }
  static std::string text_of(const fs::path& path) {
    std::ifstream file(path);
    std::ostringstream text;
    text << file.rdbuf();
    return text.str();
  }
  static ErrorKind kind_of(const std::function<void()>& act) {
    try {
      act();
    } catch (const Error& error) {
      return error.kind();
    }
    ADD_FAILURE() << "no error";
    return ErrorKind::damaged;
  }

  fs::path root_;

 private:
  static inline int counter_ = 0;
};

const std::string kManifest = R"({"welkin": "0", "files": [{"file": "a.ktx2"}, {"file": "old.ktx2"}]})";

TEST_F(SetFolder, IsMadeAndFilled) {
  EXPECT_TRUE(write(root_ / "out", {{"a.ktx2", "A"}, {"manifest.json", kManifest}}).empty());
  EXPECT_EQ(text_of(root_ / "out" / "a.ktx2"), "A");
  EXPECT_EQ(std::distance(fs::directory_iterator(root_ / "out"), fs::directory_iterator()), 2);
}

TEST_F(SetFolder, AnEarlierSetIsReplacedAndWhatIsLeftOfItTold) {
  write(root_ / "out", {{"a.ktx2", "A"}, {"old.ktx2", "O"}, {"manifest.json", kManifest}});
  const auto left = write(root_ / "out", {{"a.ktx2", "B"}, {"manifest.json", kManifest}});
  EXPECT_EQ(left, std::vector<std::string>{"old.ktx2"});
  EXPECT_EQ(text_of(root_ / "out" / "a.ktx2"), "B");
  EXPECT_EQ(text_of(root_ / "out" / "old.ktx2"), "O");
}

TEST_F(SetFolder, SomebodysOwnFilesStay) {
  std::ofstream(root_ / "index.html") << "mine";
  EXPECT_EQ(kind_of([&] { check_set_folder(root_, {"a.ktx2", "index.html"}); }), ErrorKind::bad_request);
  EXPECT_EQ(kind_of([&] {
              write(root_, {{"a.ktx2", "A"}, {"index.html", "page"}});
            }),
            ErrorKind::bad_request);
  EXPECT_EQ(text_of(root_ / "index.html"), "mine");
  EXPECT_FALSE(fs::exists(root_ / "a.ktx2"));
  // Beside others that are in nobody's way a set may lie.
  EXPECT_NO_THROW(check_set_folder(root_, {"a.ktx2"}));
}

TEST_F(SetFolder, ManifestsOfOtherProgramsListNothing) {
  for (const char* text :
       {"{\"files\": [{\"file\": \"a.ktx2\"}]}", "[1, 2", "\"welkin\"", "{\"welkin\": 1, \"files\": 3}"}) {
    std::ofstream(root_ / "manifest.json") << text;
    std::ofstream(root_ / "a.ktx2") << "mine";
    EXPECT_EQ(kind_of([&] { check_set_folder(root_, {"a.ktx2"}); }), ErrorKind::bad_request) << text;
  }
}

TEST_F(SetFolder, CheckingLeavesNothingBehind) {
  check_set_folder(root_ / "out", {"a.ktx2"});
  EXPECT_FALSE(fs::exists(root_ / "out"));
}

TEST_F(SetFolder, FoldersThatCantBeMadeAreTold) {
  EXPECT_EQ(kind_of([&] { check_set_folder(root_ / "no" / "out", {"a.ktx2"}); }), ErrorKind::not_found);
  std::ofstream(root_ / "file") << "x";
  EXPECT_EQ(kind_of([&] { check_set_folder(root_ / "file", {"a.ktx2"}); }), ErrorKind::bad_request);
}

TEST_F(SetFolder, NothingAppearsWhereOneFileFails) {
  EXPECT_THROW(write(root_ / "out", {{"a.ktx2", "A"}, {"no/b.ktx2", "B"}}), Error);
  EXPECT_FALSE(fs::exists(root_ / "out"));
}

}  // namespace
}  // namespace welkin
