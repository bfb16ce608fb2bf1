#include "welkin/io/output_file.h"

#include <sys/stat.h>
#include <unistd.h>

#include <thread>

#include "welkin/io/test_pictures.h"

namespace welkin::io::test {
namespace {

namespace fs = std::filesystem;

std::string text_of(const fs::path& path) {
  std::ifstream stream(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

void put(const fs::path& path, const std::string& text) {
  std::ofstream(path, std::ios::binary) << text;
}

void write_text(OutputFile& file, const std::string& text) {
  file.write(text.data(), text.size());
}

void commit_text(const fs::path& path, const std::string& text) {
  OutputFile file(path);
  write_text(file, text);
  file.commit();
}

TEST(OutputFile, AppearsAtCommitAndNotBefore) {
  const TemporaryFolder folder;
  OutputFile file(folder / "a.txt");
  write_text(file, "whole");
  EXPECT_FALSE(fs::exists(folder / "a.txt"));
  file.commit();
  EXPECT_EQ(text_of(folder / "a.txt"), "whole");
  EXPECT_EQ(folder.entries(), 1);
}

TEST(OutputFile, AbandonedLeavesTheOlderFileAlone) {
  const TemporaryFolder folder;
  put(folder / "a.txt", "older");
  {
    OutputFile file(folder / "a.txt");
    write_text(file, "newer");
  }
  EXPECT_EQ(text_of(folder / "a.txt"), "older");
  EXPECT_EQ(folder.entries(), 1);
}

TEST(OutputFile, SeeksAndReadsBack) {
  const TemporaryFolder folder;
  OutputFile file(folder / "a.txt");
  write_text(file, "0123456789");
  file.seek(3);
  write_text(file, "xy");
  EXPECT_EQ(file.tell(), 5u);
  EXPECT_EQ(file.size(), 10u);
  char back[16] = {};
  EXPECT_EQ(file.read_at(2, back, 4), 4u);
  EXPECT_STREQ(back, "2xy5");
  EXPECT_EQ(file.read_at(8, back, sizeof back), 2u);
  file.commit();
  EXPECT_EQ(text_of(folder / "a.txt"), "012xy56789");
}

TEST(OutputFile, KeepsAnOlderFilesModeAndObeysUmask) {
  const TemporaryFolder folder;
  put(folder / "old.txt", "");
  fs::permissions(folder / "old.txt", fs::perms{0640});
  commit_text(folder / "old.txt", "x");
  EXPECT_EQ(fs::status(folder / "old.txt").permissions(), fs::perms{0640});
  const mode_t before = ::umask(027);
  commit_text(folder / "new.txt", "x");
  ::umask(before);
  EXPECT_EQ(fs::status(folder / "new.txt").permissions(), fs::perms{0640});
}

TEST(OutputFile, ReplacesALinksTargetNotTheLink) {
  const TemporaryFolder folder;
  fs::create_directory(folder / "inner");
  put(folder / "inner/target.txt", "older");
  fs::create_symlink("inner/target.txt", folder / "link.txt");
  fs::create_symlink("inner/new.txt", folder / "dangling.txt");
  commit_text(folder / "link.txt", "newer");
  commit_text(folder / "dangling.txt", "made");
  EXPECT_TRUE(fs::is_symlink(folder / "link.txt"));
  EXPECT_TRUE(fs::is_symlink(folder / "dangling.txt"));
  EXPECT_EQ(text_of(folder / "inner/target.txt"), "newer");
  EXPECT_EQ(text_of(folder / "inner/new.txt"), "made");
}

TEST(OutputFile, LoopOfLinksIsAnError) {
  const TemporaryFolder folder;
  fs::create_symlink("b", folder / "a");
  fs::create_symlink("a", folder / "b");
  EXPECT_THROW(OutputFile file(folder / "a"), Error);
}

TEST(OutputFile, WritesThroughToDevices) {
  EXPECT_NO_THROW(commit_text("/dev/null", "gone"));
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
  const std::string message = error_of([] { commit_text("/dev/full", "too much"); });
  EXPECT_EQ(message, "No space left on device");
}

TEST(OutputFile, AFileInSharedMemoryIsReplacedAsAnyOther) {
  const fs::path path = "/dev/shm/welkin-output-file-test-" + std::to_string(::getpid());
  if (!fs::is_directory("/dev/shm")) GTEST_SKIP() << "this system has no /dev/shm";
  commit_text(path, "a longer text");
  commit_text(path, "short");
  EXPECT_EQ(text_of(path), "short");
  fs::remove(path);
}

TEST(OutputFile, WritesThroughToAPipe) {
  const TemporaryFolder folder;
  const fs::path pipe = folder / "pipe";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  std::string got;
  std::thread reader([&] { got = text_of(pipe); });
  {
    OutputFile file(pipe);
    write_text(file, "abXde");
    file.seek(2);
    write_text(file, "c");
    file.commit();
  }
  reader.join();
  EXPECT_EQ(got, "abcde");
  EXPECT_TRUE(fs::is_fifo(pipe));
}

TEST(OutputFile, FailuresSayTheSystemsReason) {
  const TemporaryFolder folder;
  EXPECT_EQ(error_of([&] { OutputFile file(folder / "no/such/a.txt"); }), "No such file or directory");
  EXPECT_EQ(error_of([&] { OutputFile file(folder.path()); }), "Is a directory");
  EXPECT_EQ(error_of([&] { OutputFile file(folder / std::string(300, 'n')); }), "File name too long");
  if (::geteuid() == 0) return;  // root may write anything
  put(folder / "fixed.txt", "x");
  fs::permissions(folder / "fixed.txt", fs::perms{0444});
  EXPECT_EQ(error_of([&] { OutputFile file(folder / "fixed.txt"); }), "Permission denied");
}

TEST(OutputFile, LongestNameStillHasATemporaryOne) {
  const TemporaryFolder folder;
  const std::string name(255, 'n');
  commit_text(folder / name, "x");
  EXPECT_EQ(text_of(folder / name), "x");
}

TEST(OutputFile, UnfinishedOutputsCanBeRemoved) {
  const TemporaryFolder folder;
  commit_text(folder / "done.txt", "x");
  OutputFile first(folder / "a.txt");
  OutputFile second(folder / "b.txt");
  EXPECT_EQ(folder.entries(), 3);
  remove_unfinished_outputs();
  EXPECT_EQ(folder.entries(), 1);
  EXPECT_THROW(first.commit(), Error);
}

TEST(OutputFile, TooManyAtOnceIsAnErrorAndTheyAreReusable) {
  const TemporaryFolder folder;
  for (int round = 0; round < 2; ++round) {
    std::vector<std::unique_ptr<OutputFile>> files;
    const std::string message = error_of([&] {
      for (int i = 0; i < 1000; ++i)
        files.push_back(std::make_unique<OutputFile>(folder / std::to_string(i)));
    });
    EXPECT_EQ(files.size(), 256u) << message;
  }
  EXPECT_EQ(folder.entries(), 0);
}

// Each of many writers of one name succeeds, and the file is the whole text of one of them.
TEST(OutputFile, ParallelWritersOfOneNameNeverMix) {
  const TemporaryFolder folder;
  std::vector<std::thread> writers;
  for (int i = 0; i < 8; ++i) {
    writers.emplace_back([&, i] {
      for (int round = 0; round < 20; ++round) {
        OutputFile file(folder / "one.txt");
        for (int line = 0; line < 50; ++line) write_text(file, std::string(100, static_cast<char>('a' + i)));
        file.commit();
      }
    });
  }
  for (auto& writer : writers) writer.join();
  const std::string text = text_of(folder / "one.txt");
  EXPECT_EQ(text, std::string(5000, text.at(0)));
  EXPECT_EQ(folder.entries(), 1);
}

TEST(InputFile, IsTheFilesBytes) {
  const TemporaryFolder folder;
  put(folder / "a.bin", "some bytes");
  put(folder / "empty.bin", "");
  const InputFile file(folder / "a.bin");
  EXPECT_EQ(Bytes(file.bytes().begin(), file.bytes().end()), bytes_of("some bytes"));
  EXPECT_TRUE(InputFile(folder / "empty.bin").bytes().empty());
}

TEST(InputFile, ReadsAPipeToItsEnd) {
  const TemporaryFolder folder;
  const fs::path pipe = folder / "pipe";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  const std::string text(3 << 20, 'p');
  std::thread writer([&] { put(pipe, text); });
  const InputFile file(pipe);
  writer.join();
  EXPECT_EQ(Bytes(file.bytes().begin(), file.bytes().end()), bytes_of(text));
}

TEST(InputFile, FailuresNameTheFileAndTheReason) {
  const TemporaryFolder folder;
  const std::string missing = (folder / "missing.hdr").string();
  EXPECT_EQ(error_of([&] { InputFile file(missing); }), missing + ": No such file or directory");
  EXPECT_EQ(error_of([&] { InputFile file(folder.path()); }), folder.path().string() + ": Is a directory");
  if (::geteuid() == 0) return;  // root may read anything
  put(folder / "secret", "x");
  fs::permissions(folder / "secret", fs::perms{0});
  EXPECT_EQ(error_of([&] { InputFile file(folder / "secret"); }),
            (folder / "secret").string() + ": Permission denied");
}

}  // namespace
}  // namespace welkin::io::test
