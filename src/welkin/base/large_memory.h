#pragma once

#include <cstddef>

namespace welkin {

/// Asks the system to back this memory with large pages where it can: touching new memory for the first time
/// costs several times less. Does nothing for less than 4 MiB, and on systems without the call.
void prefer_large_pages(void* memory, std::size_t bytes);

}  // namespace welkin
