// Reads one file and writes another in blocks of a megabyte: what the system takes for as many bytes.
//
// plain_copy IN OUT BYTES     reads all of IN; OUT gets BYTES bytes, whatever they are

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <vector>

int main(int argc, char** argv) {
  if (argc != 4) {
    std::fprintf(stderr, "plain_copy IN OUT BYTES\n");
    return 2;
  }
  std::vector<char> block(std::size_t{1} << 20);
  const int in = open(argv[1], O_RDONLY), out = open(argv[2], O_WRONLY | O_CREAT | O_TRUNC, 0666);
  ssize_t got = 0;
  while ((got = read(in, block.data(), block.size())) > 0) {
  }
  for (auto left = static_cast<std::size_t>(std::atoll(argv[3])); left > 0 && got >= 0;) {
    got = write(out, block.data(), std::min(left, block.size()));
    if (got > 0) left -= static_cast<std::size_t>(got);
  }
  if (in < 0 || out < 0 || got < 0 || close(out) != 0) {
    std::perror("plain_copy");
    return 1;
  }
}
