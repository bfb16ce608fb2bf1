#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>

#include "welkin/base/export.h"
#include "welkin/io/byte_sink.h"

/// @file
/// Files that appear when they are complete, and files mapped into memory.
namespace welkin::io {

/// A file that appears under its name only when `commit` has succeeded. Until then the bytes are in a
/// temporary file beside it, which the destructor removes, and which remove_unfinished_outputs removes from a
/// signal handler. Writes that fail (full disk…) throw Error with the system's reason, without the file's
/// name.
///
/// A symbolic link stays and its target is replaced; an older file's permissions are kept. A device or a pipe
/// is written through by `commit`, from a spool that allows seeking. At most 256 can be unfinished at once.
class WELKIN_API OutputFile final : public ByteSink {
 public:
  /// Begins a file that will be called `path`. Throws Error (not_found, denied, system), without the file's
  /// name too.
  explicit OutputFile(const std::filesystem::path& path);
  /// Removes the temporary file, unless it was committed.
  ~OutputFile() override;
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  using ByteSink::write;
  void write(std::span<const std::byte> bytes) override;
  std::size_t read_at(std::uint64_t offset, void* data, std::size_t size) override;
  void seek(std::uint64_t offset) override;
  std::uint64_t tell() const override;
  std::uint64_t size() const override;

  /// Makes the file appear under its name, in place of an older one. Once, after the last write. Throws Error
  /// (system…) when it can't; then nothing appears.
  void commit();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// A whole file, read-only, mapped into memory; a pipe is read to its end. Throws Error, `FILE: reason`. As
/// with any mapping, a file that somebody shortens meanwhile ends the process (SIGBUS).
class WELKIN_API InputFile {
 public:
  /// Opens and maps. Throws Error (not_found, denied, system).
  explicit InputFile(const std::filesystem::path& path);
  ~InputFile();
  InputFile(const InputFile&) = delete;
  InputFile& operator=(const InputFile&) = delete;

  /// All of it; valid as long as the object.
  std::span<const std::byte> bytes() const { return bytes_; }

 private:
  std::span<const std::byte> bytes_;
};

/// Unlinks the temporary files of this process. Async-signal-safe: for signal handlers.
WELKIN_API void remove_unfinished_outputs() noexcept;

}  // namespace welkin::io
