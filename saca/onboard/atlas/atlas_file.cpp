#include "saca/onboard/atlas/atlas_file.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <functional>
#include <memory>
#include <span>
#include <string_view>
#include <type_traits>
#include <utility>

#include "saca/base/core/contract.h"
#include "saca/base/core/file.h"
#include "saca/base/core/fnv.h"

namespace saca::atlas {
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

std::string_view bytes_of(const Header& header) {
  // NOLINTNEXTLINE(cppcoreguidelines-pro-type-reinterpret-cast): bytes may be read so
  return {reinterpret_cast<const char*>(&header), offsetof(Header, header_sum)};
}

Error broken(const std::string& source, const std::string& what) {
  return {Error::Code::malformed, source + ": " + what};
}

std::string as_hex(std::uint64_t number) {
  std::string text;
  for (int shift = 60; shift >= 0; shift -= 4) {
    text += "0123456789abcdef"[(number >> static_cast<unsigned>(shift)) & 15U];
  }
  return text;
}

bool sensible(const AtlasGrid& grid) {
  const auto is_finite = [](double value) { return std::isfinite(value); };
  for (const AtlasAxes& axes : grid) {
    for (const AtlasAxes::Axis* axis : {&axes.speeds, &axes.grips, &axes.ways, &axes.shares}) {
      if (axis->empty() || axis->size() > AtlasAxes::Axis::capacity() ||
          !std::all_of(axis->begin(), axis->end(), is_finite) ||
          std::adjacent_find(axis->begin(), axis->end(), std::greater_equal<>()) != axis->end()) {
        return false;
      }
    }
  }
  return true;
}

std::optional<Error> fault(const std::string& source, const Header& header,
                           std::string_view bytes) {
  if (header.sign != magic) {
    return broken(source, "is no atlas: want a file that begins with SACAATLS");
  }
  if (header.order != byte_order) {
    return broken(source, "was written on a machine with another order of bytes");
  }
  if (header.version != atlas_version) {
    return broken(source, "want version " + std::to_string(atlas_version) + ", got " +
                              std::to_string(header.version) + ": build it anew");
  }
  if (header.header_bytes != sizeof(Header) || header.node_bytes != sizeof(AtlasNode) ||
      header.header_sum != fnv1a(bytes_of(header)) || !sensible(header.grid) ||
      header.num_nodes != num_nodes(header.grid)) {
    return broken(source, "the header was altered: its checksum does not hold");
  }
  const std::uint64_t wanted = sizeof(Header) + header.num_nodes * sizeof(AtlasNode);
  if (bytes.size() != wanted) {
    return broken(source, "want " + std::to_string(wanted) + " bytes, got " +
                              std::to_string(bytes.size()) + ": it is not whole");
  }
  if (header.body_sum != fnv1a(bytes.substr(sizeof(Header)))) {
    return broken(source, "was altered: the checksum of its nodes does not hold");
  }
  return std::nullopt;
}

// Its integers may be any; a time that is no number, or below 0, would be told as one.
bool sensible(const AtlasNode& node) {
  const auto is_time = [](float time) { return std::isfinite(time) && time >= 0.0F; };
  const auto is_finite = [](float scale) { return std::isfinite(scale); };
  return is_time(node.span) && is_time(node.end) && is_time(node.sensitivity_span) &&
         node.ended <= 1 && std::all_of(node.scale.begin(), node.scale.end(), is_finite) &&
         std::all_of(node.sensitivity_scale.begin(), node.sensitivity_scale.end(), is_finite);
}

// In memory that nobody else can cut or write: a file mapped into it would change under the reader,
// and end the program where it became shorter.
struct OpenAtlas {
  std::shared_ptr<const std::string> bytes;
  std::shared_ptr<const Header> header;
  std::span<const AtlasNode> nodes;  ///< in `bytes`
};

Result<OpenAtlas> open_whole(std::string all, const std::string& source) {
  const auto bytes = std::make_shared<const std::string>(std::move(all));
  if (bytes->size() < sizeof(Header)) {
    return broken(source, "is no atlas, or cut short: want at least " +
                              std::to_string(sizeof(Header)) + " bytes, got " +
                              std::to_string(bytes->size()));
  }
  const auto header = std::make_shared<Header>();
  std::memcpy(static_cast<void*>(header.get()), bytes->data(), sizeof(Header));
  if (auto problem = fault(source, *header, *bytes)) {
    return *problem;
  }
  // The header's size keeps the nodes' alignment.
  static_assert(sizeof(Header) % alignof(AtlasNode) == 0);
  const void* const first = std::string_view(*bytes).substr(sizeof(Header)).data();
  const std::span nodes(static_cast<const AtlasNode*>(first), header->num_nodes);
  const auto wrong = std::find_if_not(nodes.begin(), nodes.end(),
                                      [](const AtlasNode& node) { return sensible(node); });
  if (wrong != nodes.end()) {
    return broken(source, "node " + std::to_string(wrong - nodes.begin()) +
                              ": want finite scales and times of 0 s or more");
  }
  return OpenAtlas{bytes, header, nodes};
}

}  // namespace

std::string atlas_bytes(const manoeuvre::Car& car, const AtlasGrid& grid,
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
  header->body_sum = fnv1a(body);
  header->header_sum = fnv1a(bytes_of(*header));
  // NOLINTNEXTLINE(cppcoreguidelines-pro-type-reinterpret-cast): bytes may be read so
  std::string all(reinterpret_cast<const char*>(header.get()), sizeof(Header));
  all += body;
  return all;
}

Result<Atlas> read_atlas(const std::filesystem::path& path, const manoeuvre::Car& car) {
  auto bytes = read_file(path, many_bytes);
  if (!bytes.has_value()) {
    return bytes.error();
  }
  return parse_atlas(std::move(bytes).value(), path.string(), car);
}

Result<Atlas> parse_atlas(std::string bytes, const std::string& source, const manoeuvre::Car& car) {
  const auto opened = open_whole(std::move(bytes), source);
  if (!opened.has_value()) {
    return opened.error();
  }
  const Header& header = *opened.value().header;
  if (header.car != car_hash(car)) {
    return Error{Error::Code::out_of_range, source + ": is of another car or tuning: want " +
                                                as_hex(car_hash(car)) + ", got " +
                                                as_hex(header.car) + ": build it anew"};
  }
  if (!alike(header.driven, behaviour(car))) {
    return Error{Error::Code::out_of_range,
                 source +
                     ": was driven by another vehicle model or controller than this program's: "
                     "build it anew"};
  }
  return Atlas(header.grid, car.tuning.domain, opened.value().nodes, opened.value().bytes);
}

Result<AtlasInfo> read_atlas_info(const std::filesystem::path& path) {
  auto bytes = read_file(path, many_bytes);
  if (!bytes.has_value()) {
    return bytes.error();
  }
  const auto opened = open_whole(std::move(bytes).value(), path.string());
  if (!opened.has_value()) {
    return opened.error();
  }
  const Header& header = *opened.value().header;
  return AtlasInfo{header.car, header.grid, opened.value().bytes->size(), header.driven};
}

}  // namespace saca::atlas
