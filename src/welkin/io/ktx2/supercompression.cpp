#include "welkin/io/ktx2/supercompression.h"

#include <libdeflate.h>
#include <zstd.h>

#include <cassert>
#include <memory>
#include <new>
#include <string>

#include "welkin/base/error.h"

namespace welkin::io::ktx2 {
namespace {

void unpack_zlib(std::span<const std::byte> packed, std::span<std::byte> to) {
  struct Free {
    void operator()(libdeflate_decompressor* p) const { libdeflate_free_decompressor(p); }
  };
  const std::unique_ptr<libdeflate_decompressor, Free> inflater(libdeflate_alloc_decompressor());
  if (inflater == nullptr) throw std::bad_alloc();
  const auto result =
      libdeflate_zlib_decompress(inflater.get(), packed.data(), packed.size(), to.data(), to.size(), nullptr);
  if (result == LIBDEFLATE_SUCCESS) return;
  throw Error(ErrorKind::damaged, result == LIBDEFLATE_BAD_DATA
                                      ? "zlib data is damaged"
                                      : "zlib data unpacks to another size than the level's");
}

}  // namespace

Buffer pack_zstd(std::span<const std::byte> bytes) {
  struct Free {
    void operator()(ZSTD_CCtx* p) const { ZSTD_freeCCtx(p); }
  };
  const std::unique_ptr<ZSTD_CCtx, Free> packer(ZSTD_createCCtx());
  if (packer == nullptr) throw std::bad_alloc();
  ZSTD_CCtx_setParameter(packer.get(), ZSTD_c_checksumFlag, 1);
  Buffer packed(ZSTD_compressBound(bytes.size()));
  const std::size_t size =
      ZSTD_compress2(packer.get(), packed.bytes().data(), packed.bytes().size(), bytes.data(), bytes.size());
  if (ZSTD_isError(size)) throw Error(ErrorKind::system, std::string("zstd: ") + ZSTD_getErrorName(size));
  packed.shrink(size);
  return packed;
}

void unpack(Scheme scheme, std::span<const std::byte> packed, std::span<std::byte> to) {
  assert(scheme != Scheme::none);
  if (scheme == Scheme::zlib) return unpack_zlib(packed, to);
  const std::size_t size = ZSTD_decompress(to.data(), to.size(), packed.data(), packed.size());
  if (ZSTD_isError(size))
    throw Error(ErrorKind::damaged, std::string("zstd data is damaged: ") + ZSTD_getErrorName(size));
  if (size != to.size()) {
    throw Error(ErrorKind::damaged,
                "zstd data unpacks to " + std::to_string(size) + " bytes, not " + std::to_string(to.size()));
  }
}

}  // namespace welkin::io::ktx2
