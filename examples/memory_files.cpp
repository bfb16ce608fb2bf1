// Files that are bytes in memory: written, read, and a picture made of one.
#include <welkin/io/capabilities.h>
#include <welkin/map_file/chain_file.h>
#include <welkin/prefilter/bake.h>
#include <welkin/synth/render_synth.h>

#include <cstdio>

int main() try {
  const auto latlong = welkin::sphere::AnyParameterization::make("latlong");
  const welkin::Map sky = welkin::render(welkin::synth::make("sky"), latlong, 64, 32);

  // Every format that can be written, if it holds values over 1 as they are.
  for (const welkin::io::Capabilities& format : welkin::io::all_capabilities()) {
    if (!format.writable || !format.hdr || !format.lossless) continue;
    welkin::io::MemorySink sink;
    welkin::write_map(sink, format.format, sky);
    const std::vector<std::byte> bytes = sink.take();
    const welkin::LoadedMap read = welkin::read_map(bytes, "sky in memory");
    std::printf("%-5s %6zu bytes, %s\n", format.format.c_str(), bytes.size(), read.info.reason.c_str());
  }

  // A chain.
  welkin::io::MemorySink sink;
  welkin::write_chain(sink, "ktx2", welkin::bake(sky));
  const welkin::Chain chain = welkin::read_chain(sink.bytes(), "chain in memory");
  std::printf("%zu levels of %s\n", chain.levels.size(), chain.notes.lobe.c_str());
} catch (const std::exception& error) {
  std::fprintf(stderr, "memory_files: %s\n", error.what());
  return 1;
}
