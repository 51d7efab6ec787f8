#include "saca/manoeuvre/atlas_file.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstddef>
#include <cstring>
#include <functional>
#include <memory>
#include <span>
#include <string_view>
#include <type_traits>

#include "saca/core/contract.h"
#include "saca/core/fnv.h"

namespace saca::manoeuvre {
namespace {

constexpr std::array<char, 8> magic{'S', 'A', 'C', 'A', 'A', 'T', 'L', 'S'};
constexpr std::uint32_t byte_order = 0x01020304;

// The file's beginning. Numbers as the machine has them: `order` tells.
struct Header {
  std::array<char, 8> sign = magic;
  std::uint32_t version = atlas_version;
  std::uint32_t order = byte_order;
  std::uint64_t header_bytes = 0;
  std::uint64_t node_bytes = sizeof(AtlasNode);
  std::uint64_t num_nodes = 0;
  std::uint64_t car = 0;
  std::uint64_t body_sum = 0;  // of the nodes
  Behaviour driven{};
  AtlasGrid grid{};
  std::uint64_t header_sum = 0;  // of all before
};
static_assert(std::is_trivially_copyable_v<Header>);
static_assert(sizeof(Header) % 8 == 0);

std::uint64_t sum_of(std::string_view bytes) {
  Fnv sum;
  sum.add(bytes);
  return sum.value();
}

std::string_view bytes_of(const Header& header) {
  // NOLINTNEXTLINE(cppcoreguidelines-pro-type-reinterpret-cast): bytes may be read so
  return {reinterpret_cast<const char*>(&header), offsetof(Header, header_sum)};
}

Error broken(const std::filesystem::path& path, const std::string& what) {
  return {Error::Code::malformed, path.string() + ": " + what};
}

std::string as_hex(std::uint64_t number) {
  std::string text;
  for (int shift = 60; shift >= 0; shift -= 4) {
    text += "0123456789abcdef"[(number >> static_cast<unsigned>(shift)) & 15U];
  }
  return text;
}

// A file in memory for as long as somebody holds it.
struct Mapping {
  void* start = nullptr;
  std::size_t size = 0;

  Mapping(void* from, std::size_t bytes) : start(from), size(bytes) {}
  Mapping(const Mapping&) = delete;
  Mapping& operator=(const Mapping&) = delete;
  ~Mapping() { ::munmap(start, size); }

  [[nodiscard]] std::string_view bytes() const { return {static_cast<const char*>(start), size}; }
};
using MappingPtr = std::shared_ptr<const Mapping>;

std::string reason_now() {
  return std::strerror(errno);  // NOLINT(concurrency-mt-unsafe): glibc's is thread-safe
}

Result<MappingPtr> mapped(const std::filesystem::path& path) {
  const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0) {
    return Error{Error::Code::unreadable, path.string() + ": cannot be opened: " + reason_now()};
  }
  struct stat about {};
  const bool known = ::fstat(file, &about) == 0 && S_ISREG(about.st_mode);
  const auto size = known ? static_cast<std::size_t>(about.st_size) : 0;
  void* const start =
      size > 0 ? ::mmap(nullptr, size, PROT_READ, MAP_PRIVATE | MAP_POPULATE, file, 0) : MAP_FAILED;
  const std::string why = reason_now();
  ::close(file);
  if (!known || size < sizeof(Header)) {
    if (start != MAP_FAILED) {
      ::munmap(start, size);
    }
    return broken(path, known ? "is no atlas, or cut short: want at least " +
                                    std::to_string(sizeof(Header)) + " bytes, got " +
                                    std::to_string(size)
                              : "want a file");
  }
  if (start == MAP_FAILED) {
    return Error{Error::Code::unreadable, path.string() + ": cannot be mapped: " + why};
  }
  return MappingPtr(std::make_shared<Mapping>(start, size));
}

bool sensible(const AtlasGrid& grid) {
  for (const AtlasAxes& axes : grid) {
    for (const AtlasAxes::Axis* axis : {&axes.speeds, &axes.grips, &axes.ways, &axes.shares}) {
      if (axis->empty() || axis->size() > AtlasAxes::Axis::capacity() ||
          std::adjacent_find(axis->begin(), axis->end(), std::greater_equal<>()) != axis->end()) {
        return false;
      }
    }
  }
  return true;
}

std::optional<Error> fault(const std::filesystem::path& path, const Header& header,
                           std::string_view bytes) {
  if (header.sign != magic) {
    return broken(path, "is no atlas: want a file that begins with SACAATLS");
  }
  if (header.order != byte_order) {
    return broken(path, "was written on a machine with another order of bytes");
  }
  if (header.version != atlas_version) {
    return broken(path, "want version " + std::to_string(atlas_version) + ", got " +
                            std::to_string(header.version) + ": build it anew");
  }
  if (header.header_bytes != sizeof(Header) || header.node_bytes != sizeof(AtlasNode) ||
      header.header_sum != sum_of(bytes_of(header)) || !sensible(header.grid) ||
      header.num_nodes != num_nodes(header.grid)) {
    return broken(path, "the header was altered: its checksum does not hold");
  }
  const std::uint64_t wanted = sizeof(Header) + header.num_nodes * sizeof(AtlasNode);
  if (bytes.size() != wanted) {
    return broken(path, "want " + std::to_string(wanted) + " bytes, got " +
                            std::to_string(bytes.size()) + ": it is not whole");
  }
  if (header.body_sum != sum_of(bytes.substr(sizeof(Header)))) {
    return broken(path, "was altered: the checksum of its nodes does not hold");
  }
  return std::nullopt;
}

struct Opened {
  MappingPtr mapping;
  std::shared_ptr<const Header> header;
};

Result<Opened> open_whole(const std::filesystem::path& path) {
  auto mapping = mapped(path);
  if (!mapping.has_value()) {
    return mapping.error();
  }
  const auto header = std::make_shared<Header>();
  std::memcpy(static_cast<void*>(header.get()), mapping.value()->start, sizeof(Header));
  if (auto problem = fault(path, *header, mapping.value()->bytes())) {
    return *problem;
  }
  return Opened{mapping.value(), header};
}

}  // namespace

std::string atlas_bytes(const Car& car, const AtlasGrid& grid,
                        const std::vector<AtlasNode>& nodes) {
  expects(nodes.size() == num_nodes(grid), "one node for each point of the grid");
  // Bytes between fields, if there were any, are to be the same each time.
  const auto header = std::make_unique<Header>();
  header->header_bytes = sizeof(Header);
  header->num_nodes = nodes.size();
  header->car = car_hash(car);
  header->driven = behaviour(car);
  header->grid = grid;
  // NOLINTNEXTLINE(cppcoreguidelines-pro-type-reinterpret-cast): bytes may be read so
  const std::string_view body(reinterpret_cast<const char*>(nodes.data()),
                              nodes.size() * sizeof(AtlasNode));
  header->body_sum = sum_of(body);
  header->header_sum = sum_of(bytes_of(*header));
  // NOLINTNEXTLINE(cppcoreguidelines-pro-type-reinterpret-cast): bytes may be read so
  std::string all(reinterpret_cast<const char*>(header.get()), sizeof(Header));
  all += body;
  return all;
}

Result<Atlas> read_atlas(const std::filesystem::path& path, const Car& car) {
  const auto opened = open_whole(path);
  if (!opened.has_value()) {
    return opened.error();
  }
  const Header& header = *opened.value().header;
  if (header.car != car_hash(car)) {
    return Error{Error::Code::out_of_range, path.string() + ": is of another car or tuning: want " +
                                                as_hex(car_hash(car)) + ", got " +
                                                as_hex(header.car) + ": build it anew"};
  }
  if (!alike(header.driven, behaviour(car))) {
    return Error{Error::Code::out_of_range,
                 path.string() +
                     ": was driven by another vehicle model or controller than this program's: "
                     "build it anew"};
  }
  const MappingPtr& mapping = opened.value().mapping;
  // The header's size keeps the nodes' alignment.
  static_assert(sizeof(Header) % alignof(AtlasNode) == 0);
  const void* const first = mapping->bytes().substr(sizeof(Header)).data();
  const std::span nodes(static_cast<const AtlasNode*>(first), header.num_nodes);
  return Atlas(header.grid, car.tuning.domain, nodes, mapping);
}

Result<AtlasInfo> read_atlas_info(const std::filesystem::path& path) {
  const auto opened = open_whole(path);
  if (!opened.has_value()) {
    return opened.error();
  }
  const Header& header = *opened.value().header;
  return AtlasInfo{header.car, header.grid, opened.value().mapping->size, header.driven};
}

}  // namespace saca::manoeuvre
