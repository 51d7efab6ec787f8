#include "saca/base/formats/tensors.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "saca/base/core/contract.h"
#include "saca/base/formats/json_text.h"

namespace saca::formats {
namespace {

using nlohmann::json;

static_assert(std::endian::native == std::endian::little, "the format is little-endian");

constexpr std::size_t longest_header = 1'000'000;  // bytes; far more than any file of ours needs
constexpr const char* words_key = "__metadata__";

std::size_t num_values(const std::vector<std::size_t>& shape) {
  std::size_t num = 1;
  for (const std::size_t extent : shape) {
    num *= extent;
  }
  return num;
}

Error malformed_tensors(std::string_view source, const std::string& what) {
  return {Error::Code::malformed, fmt::format("{}: {}", source, what)};
}

/// Where one tensor lies among the numbers.
struct Entry {
  std::string name;
  std::vector<std::size_t> shape{};
  std::size_t begin = 0;
  std::size_t end = 0;
};

/// nullopt: not an array of whole numbers from `least` to the largest possible file.
std::optional<std::vector<std::size_t>> sizes(const json& value, std::size_t least) {
  if (!value.is_array()) {
    return std::nullopt;
  }
  std::vector<std::size_t> found;
  for (const json& each : value) {
    constexpr std::size_t most = std::size_t{1} << 31U;
    if (!each.is_number_unsigned() || each.get<std::size_t>() < least ||
        each.get<std::size_t>() > most) {
      return std::nullopt;
    }
    found.push_back(each.get<std::size_t>());
  }
  return found;
}

Result<Entry> entry(const std::string& name, const json& value, std::size_t num_bytes,
                    std::string_view source) {
  const auto wanted = [&](const std::string& what) {
    return malformed_tensors(source, fmt::format("tensor {}: {}", name, what));
  };
  if (!value.is_object() || !value.contains("dtype") || value["dtype"] != "F32") {
    return wanted("want dtype F32");
  }
  const auto shape = value.contains("shape") ? sizes(value["shape"], 1)
                                             : std::optional<std::vector<std::size_t>>();
  if (!shape || shape->size() > 4) {
    return wanted("want a shape of at most four whole numbers from 1 on");
  }
  const auto offsets = value.contains("data_offsets") ? sizes(value["data_offsets"], 0)
                                                      : std::optional<std::vector<std::size_t>>();
  if (!offsets || offsets->size() != 2 || (*offsets)[0] > (*offsets)[1] ||
      (*offsets)[1] > num_bytes) {
    return wanted(fmt::format("want two data_offsets up to {}", num_bytes));
  }
  const std::size_t size = (*offsets)[1] - (*offsets)[0];
  std::size_t room = size / sizeof(float);
  for (const std::size_t extent : *shape) {
    room /= extent;  // not multiplied: that could overflow
  }
  if (room == 0 || num_values(*shape) * sizeof(float) != size) {
    return wanted(
        fmt::format("a shape of [{}] does not take {} bytes", fmt::join(*shape, ", "), size));
  }
  return Entry{name, *shape, (*offsets)[0], (*offsets)[1]};
}

Result<std::vector<Entry>> entries(const json& header, std::size_t num_bytes,
                                   std::string_view source) {
  std::vector<Entry> found;
  for (const auto& [name, value] : header.items()) {
    if (name == words_key) {
      continue;
    }
    auto one = entry(name, value, num_bytes, source);
    if (!one.has_value()) {
      return one.error();
    }
    found.push_back(std::move(one).value());
  }
  std::sort(found.begin(), found.end(),
            [](const Entry& a, const Entry& b) { return a.begin < b.begin; });
  std::size_t at = 0;
  for (const Entry& each : found) {
    if (each.begin != at) {
      return malformed_tensors(source, fmt::format("tensor {}: want it to begin at {}, got {}",
                                                   each.name, at, each.begin));
    }
    at = each.end;
  }
  if (at != num_bytes) {
    return malformed_tensors(source,
                             fmt::format("want {} bytes of numbers, got {}", at, num_bytes));
  }
  return found;
}

Result<json> header_of(std::string_view bytes, std::string_view source, std::size_t& size) {
  std::uint64_t told = 0;
  if (bytes.size() < sizeof told) {
    return malformed_tensors(
        source, "want a safetensors file, got one of " + std::to_string(bytes.size()) + " bytes");
  }
  std::memcpy(&told, bytes.data(), sizeof told);
  if (told > longest_header || told > bytes.size() - sizeof told) {
    return malformed_tensors(source, fmt::format("want a safetensors file, got a header of {} "
                                                 "bytes in a file of {}",
                                                 told, bytes.size()));
  }
  size = static_cast<std::size_t>(told);
  auto header = parse_json(bytes.substr(sizeof told, size));
  if (!header.has_value() || !header.value().is_object()) {
    return malformed_tensors(source, "want a safetensors header: one JSON object");
  }
  return header;
}

}  // namespace

Result<Tensors> read_tensors(std::string_view bytes, std::string_view source) {
  std::size_t header_size = 0;
  const auto header = header_of(bytes, source, header_size);
  if (!header.has_value()) {
    return header.error();
  }
  const std::string_view numbers = bytes.substr(sizeof(std::uint64_t) + header_size);
  const auto found = entries(header.value(), numbers.size(), source);
  if (!found.has_value()) {
    return found.error();
  }
  Tensors result;
  if (header.value().contains(words_key)) {
    const json& words = header.value()[words_key];
    for (const auto& [key, value] : words.items()) {
      if (!words.is_object() || !value.is_string()) {
        return malformed_tensors(source, "__metadata__: want texts by name");
      }
      result.words[key] = value.get<std::string>();
    }
  }
  for (const Entry& each : found.value()) {
    Tensor tensor{each.shape, std::vector<float>(num_values(each.shape))};
    std::memcpy(tensor.values.data(), numbers.data() + each.begin, each.end - each.begin);
    if (!std::all_of(tensor.values.begin(), tensor.values.end(),
                     [](float x) { return std::isfinite(x); })) {
      return malformed_tensors(source, fmt::format("tensor {}: want finite numbers", each.name));
    }
    result.tensors[each.name] = std::move(tensor);
  }
  return result;
}

Result<Tensors> read_tensor_file(const std::filesystem::path& path, std::uintmax_t most) {
  const auto bytes = read_file(path, most);
  return bytes.has_value() ? read_tensors(bytes.value(), path.string())
                           : Result<Tensors>(bytes.error());
}

std::string tensor_bytes(const Tensors& tensors) {
  json header = json::object();
  if (!tensors.words.empty()) {
    header[words_key] = tensors.words;
  }
  std::string numbers;
  for (const auto& [name, tensor] : tensors.tensors) {
    expects(tensor.values.size() == num_values(tensor.shape), "as many numbers as the shape says");
    const std::size_t begin = numbers.size();
    numbers.resize(begin + tensor.values.size() * sizeof(float));
    std::memcpy(numbers.data() + begin, tensor.values.data(), numbers.size() - begin);
    header[name] = {
        {"dtype", "F32"}, {"shape", tensor.shape}, {"data_offsets", {begin, numbers.size()}}};
  }
  std::string text = header.dump();
  text.append((sizeof(std::uint64_t) - text.size() % sizeof(std::uint64_t)) % sizeof(std::uint64_t),
              ' ');  // so that the numbers stand aligned
  const auto size = static_cast<std::uint64_t>(text.size());
  std::string bytes(sizeof size, '\0');
  std::memcpy(bytes.data(), &size, sizeof size);
  return bytes + text + numbers;
}

Result<std::vector<float>> take(const Tensors& tensors, const std::string& name,
                                const std::vector<std::size_t>& shape, std::string_view source) {
  const auto found = tensors.tensors.find(name);
  if (found == tensors.tensors.end()) {
    return malformed_tensors(source, fmt::format("want a tensor {}", name));
  }
  if (found->second.shape != shape) {
    return malformed_tensors(
        source, fmt::format("tensor {}: want a shape of [{}], got [{}]", name,
                            fmt::join(shape, ", "), fmt::join(found->second.shape, ", ")));
  }
  return found->second.values;
}

void Layer::add_to(Fnv& hash) const {
  for (const std::vector<float>* numbers : {&weight, &bias}) {
    for (const float number : *numbers) {
      hash.add(std::bit_cast<std::uint32_t>(number));
    }
  }
}

Result<Layer> take_layer(const Tensors& tensors, const std::string& name, std::size_t rows,
                         std::size_t columns, std::string_view source) {
  auto weight = take(tensors, name + ".weight", {rows, columns}, source);
  if (!weight.has_value()) {
    return weight.error();
  }
  auto bias = take(tensors, name + ".bias", {rows}, source);
  if (!bias.has_value()) {
    return bias.error();
  }
  return Layer{rows, columns, std::move(weight).value(), std::move(bias).value()};
}

}  // namespace saca::formats
