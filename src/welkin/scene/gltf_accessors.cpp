#include <algorithm>
#include <cstring>

#include "welkin/base/error.h"
#include "welkin/scene/gltf_file.h"

namespace welkin::scene {
namespace {

[[noreturn]] void damaged(const std::string& cause) {
  throw Error(ErrorKind::damaged, cause);
}

template <class T>
T read_as(const std::byte* from) {
  T value;
  std::memcpy(&value, from, sizeof value);
  return value;
}

std::size_t size_of_component(int type) {
  switch (type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return 1;
    case TINYGLTF_COMPONENT_TYPE_SHORT:
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return 2;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
    case TINYGLTF_COMPONENT_TYPE_FLOAT:
      return 4;
    default:
      return 0;
  }
}

/// One stored number; integers that are `normalized` over their largest.
double component_at(const std::byte* from, int type, bool normalized) {
  const auto over = [&](double value, double largest) {
    return normalized ? std::max(value / largest, -1.0) : value;
  };
  switch (type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
      return over(read_as<std::int8_t>(from), 127);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return over(read_as<std::uint8_t>(from), 255);
    case TINYGLTF_COMPONENT_TYPE_SHORT:
      return over(read_as<std::int16_t>(from), 32767);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return over(read_as<std::uint16_t>(from), 65535);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
      return over(read_as<std::uint32_t>(from), 4294967295.0);
    default:
      return read_as<float>(from);
  }
}

/// Elements at even distances, all of them inside the buffer.
struct Elements {
  const std::byte* first;
  std::size_t stride;
};

Elements elements_of(const GltfFile& file, int view_index, std::size_t offset, std::size_t count,
                     std::size_t size, bool strided, const std::string& what) {
  const GltfView view = view_of(file, view_index);
  const std::size_t stride = strided && view.stride > 0 ? view.stride : size;
  if (stride < size) damaged(what + ": its elements overlap");
  const std::size_t room = view.bytes.size();
  if (count > 0 && (offset > room || size > room - offset || count - 1 > (room - offset - size) / stride))
    damaged(what + ": " + std::to_string(count) + " elements don't fit into buffer view " +
            std::to_string(view_index));
  return {view.bytes.data() + offset, stride};
}

const tinygltf::Accessor& accessor_of(const GltfFile& file, int index, int components,
                                      const std::string& what) {
  if (index < 0 || static_cast<std::size_t>(index) >= file.model.accessors.size())
    damaged(what + " are of an accessor that there isn't");
  const tinygltf::Accessor& accessor = file.model.accessors[static_cast<std::size_t>(index)];
  if (tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(accessor.type)) != components)
    damaged(what + ": accessor " + std::to_string(index) + " has another number of components than " +
            std::to_string(components));
  if (size_of_component(accessor.componentType) == 0)
    damaged(what + ": accessor " + std::to_string(index) + " is of numbers that glTF doesn't have");
  if (accessor.count > kMostElements) throw Error(ErrorKind::too_large, what + ": over 200,000,000 elements");
  return accessor;
}

/// Calls set(element, component, value) for all that is stored: the plain elements, then the sparse ones.
template <class Set>
void for_each_stored(const GltfFile& file, const tinygltf::Accessor& accessor, int components,
                     const std::string& what, const Set& set) {
  const std::size_t each = size_of_component(accessor.componentType),
                    size = each * static_cast<std::size_t>(components);
  const auto put = [&](std::size_t element, const std::byte* from) {
    for (int i = 0; i < components; ++i)
      set(element, i,
          component_at(from + static_cast<std::size_t>(i) * each, accessor.componentType,
                       accessor.normalized));
  };
  if (accessor.bufferView >= 0) {
    const Elements from =
        elements_of(file, accessor.bufferView, accessor.byteOffset, accessor.count, size, true, what);
    for (std::size_t i = 0; i < accessor.count; ++i) put(i, from.first + i * from.stride);
  }
  if (!accessor.sparse.isSparse) return;
  const auto& sparse = accessor.sparse;
  const std::size_t wide = size_of_component(sparse.indices.componentType);
  if (sparse.count < 0 || static_cast<std::size_t>(sparse.count) > accessor.count || wide == 0 ||
      sparse.indices.byteOffset < 0 || sparse.values.byteOffset < 0)
    damaged(what + ": its sparse elements are not valid");
  const auto count = static_cast<std::size_t>(sparse.count);
  const Elements indices =
      elements_of(file, sparse.indices.bufferView, static_cast<std::size_t>(sparse.indices.byteOffset), count,
                  wide, false, what);
  const Elements values =
      elements_of(file, sparse.values.bufferView, static_cast<std::size_t>(sparse.values.byteOffset), count,
                  size, false, what);
  for (std::size_t i = 0; i < count; ++i) {
    const double index =
        component_at(indices.first + i * indices.stride, sparse.indices.componentType, false);
    if (!(index >= 0 && index < static_cast<double>(accessor.count)))
      damaged(what + ": a sparse element is of none");
    put(static_cast<std::size_t>(index), values.first + i * values.stride);
  }
}

/// Elements that no byte of the file stands for are taken to be 0, but not without end.
void check_backed(const tinygltf::Accessor& accessor, const std::string& what) {
  constexpr std::size_t kMostEmpty = std::size_t{1} << 22;
  if (accessor.bufferView < 0 && accessor.count > kMostEmpty)
    throw Error(ErrorKind::too_large, what + ": over 4,194,304 elements without data");
}

}  // namespace

std::vector<float> read_floats(const GltfFile& file, int index, int components, const std::string& what) {
  const tinygltf::Accessor& accessor = accessor_of(file, index, components, what);
  check_backed(accessor, what);
  if (accessor.bufferView >= 0)  // before memory is taken
    elements_of(file, accessor.bufferView, accessor.byteOffset, accessor.count,
                size_of_component(accessor.componentType) * static_cast<std::size_t>(components), true, what);
  std::vector<float> values(accessor.count * static_cast<std::size_t>(components));
  for_each_stored(file, accessor, components, what, [&](std::size_t element, int component, double value) {
    values[element * static_cast<std::size_t>(components) + static_cast<std::size_t>(component)] =
        static_cast<float>(value);
  });
  return values;
}

std::vector<std::uint32_t> read_indices(const GltfFile& file, int index, const std::string& what) {
  const tinygltf::Accessor& accessor = accessor_of(file, index, 1, what);
  if (accessor.componentType == TINYGLTF_COMPONENT_TYPE_FLOAT) damaged(what + " are no whole numbers");
  check_backed(accessor, what);
  if (accessor.bufferView >= 0)
    elements_of(file, accessor.bufferView, accessor.byteOffset, accessor.count,
                size_of_component(accessor.componentType), true, what);
  std::vector<std::uint32_t> values(accessor.count);
  for_each_stored(file, accessor, 1, what, [&](std::size_t element, int, double value) {
    values[element] = value >= 0 ? static_cast<std::uint32_t>(value) : 0xffffffffu;
  });
  return values;
}

}  // namespace welkin::scene
