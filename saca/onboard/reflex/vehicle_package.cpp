#include "saca/onboard/reflex/vehicle_package.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <optional>
#include <span>
#include <type_traits>
#include <utility>

#include "saca/base/core/contract.h"
#include "saca/base/core/file.h"
#include "saca/base/core/fnv.h"
#include "saca/onboard/atlas/atlas_file.h"

namespace saca::reflex {
namespace {

constexpr std::array<char, 8> magic{'S', 'A', 'C', 'A', 'V', 'P', 'K', 'G'};
constexpr std::uint32_t byte_order = 0x01020304;
// Changed by hand when a field of a car or of the harm model is added, removed or moved.
constexpr std::uint32_t package_version = 1;

// Cars and harm models consist of doubles only.
template <class Doubles>
using Numbers = std::array<double, sizeof(Doubles) / sizeof(double)>;

// The file's beginning; the atlas' file follows. Numbers as the machine has them: `order` tells.
struct Header {
  std::array<char, 8> sign = magic;
  std::uint32_t version = package_version;
  std::uint32_t order = byte_order;
  std::uint64_t header_bytes = 0;
  std::uint64_t atlas_bytes = 0;
  std::uint64_t atlas_sum = 0;
  std::array<char, longest_package_name + 1> name{};  // zeros behind it
  Numbers<manoeuvre::Car> car{};
  Numbers<collision::HarmModel> harm{};
  std::uint64_t header_sum = 0;  // of all before
};
static_assert(std::is_trivially_copyable_v<Header>);
static_assert(sizeof(Header) % 8 == 0);

std::string_view bytes_of(const Header& header) {
  // NOLINTNEXTLINE(cppcoreguidelines-pro-type-reinterpret-cast): bytes may be read so
  return {reinterpret_cast<const char*>(&header), offsetof(Header, header_sum)};
}

bool is_finite(std::span<const double> numbers) {
  return std::all_of(numbers.begin(), numbers.end(),
                     [](double number) { return std::isfinite(number); });
}

std::optional<std::string> fault(const Header& header, std::string_view bytes) {
  if (header.sign != magic) {
    return "is no vehicle package: want a file that begins with SACAVPKG";
  }
  if (header.order != byte_order) {
    return "was written on a machine with another order of bytes";
  }
  if (header.version != package_version) {
    return "want version " + std::to_string(package_version) + ", got " +
           std::to_string(header.version) + ": make it anew";
  }
  if (header.header_bytes != sizeof(Header) || header.header_sum != fnv1a(bytes_of(header)) ||
      header.name.back() != 0 || !is_finite(header.car) || !is_finite(header.harm)) {
    return "the head was altered: its checksum does not hold";
  }
  const std::string_view atlas = bytes.substr(sizeof(Header));
  if (atlas.size() != header.atlas_bytes) {
    return "want " + std::to_string(header.atlas_bytes) + " bytes of its atlas, got " +
           std::to_string(atlas.size()) + ": it is not whole";
  }
  if (header.atlas_sum != fnv1a(atlas)) {
    return "was altered: the checksum of its atlas does not hold";
  }
  return std::nullopt;
}

}  // namespace

std::string vehicle_package_bytes(std::string_view name, const manoeuvre::Car& car,
                                  const collision::HarmModel& harm, std::string_view atlas) {
  expects(name.size() <= longest_package_name && name.find('\0') == std::string_view::npos,
          "a short name without zeros");
  Header header;
  header.header_bytes = sizeof(Header);
  header.atlas_bytes = atlas.size();
  header.atlas_sum = fnv1a(atlas);
  std::copy(name.begin(), name.end(), header.name.begin());
  header.car = std::bit_cast<Numbers<manoeuvre::Car>>(car);
  header.harm = std::bit_cast<Numbers<collision::HarmModel>>(harm);
  expects(is_finite(header.car) && is_finite(header.harm), "finite numbers");
  header.header_sum = fnv1a(bytes_of(header));
  // NOLINTNEXTLINE(cppcoreguidelines-pro-type-reinterpret-cast): bytes may be read so
  std::string all(reinterpret_cast<const char*>(&header), sizeof(Header));
  all += atlas;
  return all;
}

Result<VehiclePackage> read_vehicle_package(const std::filesystem::path& path) {
  const auto read = read_file(path, many_bytes);
  if (!read.has_value()) {
    return read.error();
  }
  const std::string_view bytes = read.value();
  const auto broken = [&](const std::string& what) {
    return Error{Error::Code::malformed, path.string() + ": " + what};
  };
  if (bytes.size() < sizeof(Header)) {
    return broken("is no vehicle package, or cut short: want at least " +
                  std::to_string(sizeof(Header)) + " bytes, got " + std::to_string(bytes.size()));
  }
  Header header;
  std::memcpy(static_cast<void*>(&header), bytes.data(), sizeof(Header));
  if (const auto problem = fault(header, bytes)) {
    return broken(*problem);
  }
  const auto car = std::bit_cast<manoeuvre::Car>(header.car);
  auto atlas = atlas::parse_atlas(std::string(bytes.substr(sizeof(Header))),
                                  path.string() + ": its atlas", car);
  if (!atlas.has_value()) {
    return atlas.error();
  }
  return VehiclePackage{header.name.data(), car, std::bit_cast<collision::HarmModel>(header.harm),
                        std::move(atlas).value()};
}

}  // namespace saca::reflex
