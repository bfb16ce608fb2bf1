#include "welkin/base/large_memory.h"

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <map>
#include <mutex>
#include <new>

#if defined(__has_feature)
#if __has_feature(address_sanitizer)
#define WELKIN_PLAIN_MEMORY
#endif
#endif
#if defined(__SANITIZE_ADDRESS__) || !defined(__linux__)
#define WELKIN_PLAIN_MEMORY
#endif
#if !defined(WELKIN_PLAIN_MEMORY)
#include <sys/mman.h>
#endif

namespace welkin {
namespace {

constexpr std::size_t kAlignment = 64;

std::size_t rounded(std::size_t bytes, std::size_t to) {
  return (bytes + to - 1) / to * to;
}

std::byte* take_plain(std::size_t size, LargeMemory::Contents contents) {
  void* memory = std::aligned_alloc(kAlignment, size);
  if (memory == nullptr) throw std::bad_alloc();
  if (contents == LargeMemory::Contents::zero) std::memset(memory, 0, size);
  return static_cast<std::byte*>(memory);
}

#if defined(WELKIN_PLAIN_MEMORY)

std::byte* take(std::size_t size, LargeMemory::Contents contents) {
  return take_plain(size, contents);
}

void give_back(std::byte* memory, std::size_t) {
  std::free(memory);
}

#else

constexpr std::size_t kHugePage = std::size_t{2} << 20;
constexpr std::size_t kSmallest = std::size_t{64} << 10;  ///< that is allocated in a region
constexpr std::size_t kLargest = std::size_t{32} << 20;   ///< likewise
constexpr std::size_t kRegion = std::size_t{64} << 20;
constexpr std::ptrdiff_t kKept = 2;  ///< unused regions that stay allocated

/// Fresh pages, all zero, that begin at a huge page's boundary.
std::byte* map_pages(std::size_t size) {
  void* mapped = mmap(nullptr, size + kHugePage, PROT_READ | PROT_WRITE,
                      MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  if (mapped == MAP_FAILED) throw std::bad_alloc();
  auto* begin = static_cast<std::byte*>(mapped);
  const std::size_t before = (kHugePage - reinterpret_cast<std::uintptr_t>(begin) % kHugePage) % kHugePage;
  if (before > 0) munmap(begin, before);
  begin += before;
  if (before < kHugePage) munmap(begin + size, kHugePage - before);
  // A hint: there is nothing to do where it is refused.
  (void)madvise(begin, size, MADV_HUGEPAGE);
  return begin;
}

/// Blocks of 64 KiB to 32 MiB, each where it first fits, so that pages that were touched are used again.
class Pool {
 public:
  std::byte* take(std::size_t size, LargeMemory::Contents contents) {
    std::byte* block = nullptr;
    std::size_t used = 0;  // bytes of the block that may not be zero
    {
      const std::scoped_lock lock(mutex_);
      auto region = regions_.begin();
      while (region != regions_.end() &&
             (block = region->second.take(region->first, size, used)) == nullptr) {
        ++region;
      }
      if (block == nullptr) {
        std::byte* begin = map_pages(kRegion);
        block = regions_.emplace(begin, Region{}).first->second.take(begin, size, used);
      }
    }
    if (contents == LargeMemory::Contents::zero) std::memset(block, 0, used);
    return block;
  }

  void give_back(std::byte* block, std::size_t size) {
    const std::scoped_lock lock(mutex_);
    const auto region = std::prev(regions_.upper_bound(block));
    region->second.give_back(static_cast<std::size_t>(block - region->first), size);
    if (!region->second.unused()) return;
    const auto unused = std::count_if(regions_.begin(), regions_.end(),
                                      [](const auto& each) { return each.second.unused(); });
    if (unused <= kKept) return;
    munmap(region->first, kRegion);
    regions_.erase(region);
  }

 private:
  class Region {
   public:
    bool unused() const { return free_.size() == 1 && free_.begin()->second == kRegion; }

    std::byte* take(std::byte* begin, std::size_t size, std::size_t& used) {
      const auto span =
          std::find_if(free_.begin(), free_.end(), [&](const auto& each) { return each.second >= size; });
      if (span == free_.end()) return nullptr;
      const auto [offset, length] = *span;
      free_.erase(span);
      if (length > size) free_.emplace(offset + size, length - size);
      used = std::min(size, touched_ - std::min(touched_, offset));
      touched_ = std::max(touched_, offset + size);
      return begin + offset;
    }

    void give_back(std::size_t offset, std::size_t size) {
      auto after = free_.upper_bound(offset);
      if (after != free_.end() && after->first == offset + size) {
        size += after->second;
        after = free_.erase(after);
      }
      if (after != free_.begin()) {
        auto& [start, length] = *std::prev(after);
        if (start + length == offset) {
          length += size;
          return;
        }
      }
      free_.emplace(offset, size);
    }

   private:
    std::map<std::size_t, std::size_t> free_{{0, kRegion}};  ///< offset → bytes
    std::size_t touched_ = 0;                                ///< pages from here on were never handed out
  };

  std::mutex mutex_;
  std::map<std::byte*, Region> regions_;
};

/// Lives as long as the process: images may be static.
Pool& pool() {
  static Pool* const made = new Pool;
  return *made;
}

std::byte* take(std::size_t size, LargeMemory::Contents contents) {
  if (size < kSmallest) return take_plain(size, contents);
  if (size > kLargest) return map_pages(rounded(size, kHugePage));
  return pool().take(size, contents);
}

void give_back(std::byte* memory, std::size_t size) {
  if (size < kSmallest) {
    std::free(memory);
  } else if (size > kLargest) {
    munmap(memory, rounded(size, kHugePage));
  } else {
    pool().give_back(memory, size);
  }
}

#endif

}  // namespace

LargeMemory::LargeMemory(std::size_t bytes, Contents contents) {
  const std::size_t size = rounded(std::max<std::size_t>(bytes, 1), kAlignment);
  if (size < bytes) throw std::bad_alloc();
  data_ = take(size, contents);
  size_ = size;
}

LargeMemory::~LargeMemory() {
  if (data_ != nullptr) give_back(data_, size_);
}

}  // namespace welkin
