#include "welkin/base/large_memory.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <cstring>
#include <random>
#include <thread>
#include <vector>

namespace welkin {
namespace {

using Contents = LargeMemory::Contents;

/// The heap's, regions' and regions of their own.
constexpr std::size_t kSizes[] = {0, 1, 100, 5000, 65536, 65537, 1 << 20, (3 << 20) + 8, 40 << 20};

bool all_are(const LargeMemory& memory, std::size_t bytes, int value) {
  return std::all_of(memory.data(), memory.data() + bytes,
                     [&](std::byte each) { return each == static_cast<std::byte>(value); });
}

TEST(LargeMemory, IsAlignedAndWritable) {
  for (const std::size_t size : kSizes) {
    LargeMemory memory(size, Contents::unset);
    EXPECT_EQ(reinterpret_cast<std::uintptr_t>(memory.data()) % 64, 0u) << size;
    EXPECT_GE(memory.size(), size);
    std::memset(memory.data(), 7, size);
    EXPECT_TRUE(all_are(memory, size, 7)) << size;
  }
}

/// Also in memory that was written before.
TEST(LargeMemory, IsZeroWhenRequested) {
  for (int round = 0; round < 3; ++round) {
    for (const std::size_t size : kSizes) {
      LargeMemory memory(size, Contents::zero);
      EXPECT_TRUE(all_are(memory, size, 0)) << size;
      std::memset(memory.data(), 9, size);
    }
  }
}

TEST(LargeMemory, MovesAndIsEmptyByDefault) {
  LargeMemory none, first(100000, Contents::zero);
  EXPECT_EQ(none.data(), nullptr);
  EXPECT_EQ(none.size(), 0u);
  std::memset(first.data(), 3, 100000);
  LargeMemory second(std::move(first));
  EXPECT_TRUE(all_are(second, 100000, 3));
  none = std::move(second);
  EXPECT_TRUE(all_are(none, 100000, 3));
}

/// Blocks allocated and freed in any order by several threads do not overlap: each still holds what was
/// written when it was allocated.
TEST(LargeMemory, BlocksDontOverlap) {
  std::atomic<int> damaged{0};
  const auto work = [&](unsigned seed) {
    std::mt19937 random(seed);
    struct Block {
      LargeMemory memory;
      std::size_t size;
      int value;
    };
    std::vector<Block> blocks;
    for (int step = 0; step < 200; ++step) {
      const std::size_t size = std::size_t{1} << (14 + random() % 8), odd = random() % 1000;
      const int value = static_cast<int>(random() % 255) + 1;
      const bool zero = random() % 2 == 0;
      Block block{LargeMemory(size + odd, zero ? Contents::zero : Contents::unset), size + odd, value};
      if (zero && !all_are(block.memory, block.size, 0)) ++damaged;
      std::memset(block.memory.data(), value, block.size);
      blocks.push_back(std::move(block));
      if (blocks.size() < 24) continue;
      const std::size_t chosen = random() % blocks.size();
      if (!all_are(blocks[chosen].memory, blocks[chosen].size, blocks[chosen].value)) ++damaged;
      std::swap(blocks[chosen], blocks.back());
      blocks.pop_back();
    }
    for (const Block& block : blocks) damaged += all_are(block.memory, block.size, block.value) ? 0 : 1;
  };
  std::vector<std::thread> threads;
  for (unsigned seed = 1; seed <= 3; ++seed) threads.emplace_back(work, seed);
  for (std::thread& each : threads) each.join();
  EXPECT_EQ(damaged, 0);
}

TEST(LargeMemory, TooMuchThrows) {
  EXPECT_THROW(LargeMemory(SIZE_MAX - 10, Contents::unset), std::bad_alloc);
}

}  // namespace
}  // namespace welkin
