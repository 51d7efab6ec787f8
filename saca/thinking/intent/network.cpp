#include "saca/thinking/intent/network.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <utility>
#include <xsimd/xsimd.hpp>

namespace saca::intent {
namespace {

constexpr std::size_t tile = 16;        // rows: two columns of them fill half of the registers
constexpr double largest_score = 20.0;  // of an emission: no class is ever excluded for good

using Pack = xsimd::batch<float>;

static_assert(Encoder::width % Pack::size == 0);

template <class Function, std::size_t size>
void for_each_pack(std::array<float, size>& x, Function&& function) {
  for (std::size_t i = 0; i < size; i += Pack::size) {
    function(Pack::load_unaligned(&x[i])).store_unaligned(&x[i]);
  }
}

Pack sigmoid(const Pack& x) {
  return 1.0F / (1.0F + xsimd::exp(-x));
}

}  // namespace

Scores mirrored(const Scores& scores) {
  return {scores[0], scores[2], scores[1], scores[3], scores[5], scores[4]};
}

Result<DenseLayer> DenseLayer::from(const formats::Tensors& tensors, const std::string& name,
                                    std::size_t rows, std::size_t columns,
                                    std::string_view source) {
  auto taken = formats::take_layer(tensors, name, rows, columns, source);
  if (!taken.has_value()) {
    return taken.error();
  }
  formats::Layer layer = std::move(taken).value();
  DenseLayer result{.num_columns = columns, .weight = {}, .bias = std::move(layer.bias)};
  const std::size_t num_tiles = (rows + tile - 1) / tile;
  result.bias.resize(num_tiles * tile);
  result.weight.resize(num_tiles * tile * columns);
  for (std::size_t row = 0; row < rows; ++row) {
    for (std::size_t column = 0; column < columns; ++column) {
      result.weight[(row / tile * columns + column) * tile + row % tile] =
          layer.weight[row * columns + column];
    }
  }
  return result;
}

Result<Encoder> Encoder::from(const formats::Tensors& tensors, const std::string& prefix,
                              std::string_view source) {
  auto input = DenseLayer::from(tensors, prefix + "input", width, num_features, source);
  auto lstm = DenseLayer::from(tensors, prefix + "lstm", 4 * width, 2 * width, source);
  for (const auto* each : {&input, &lstm}) {
    if (!each->has_value()) {
      return each->error();
    }
  }
  Encoder encoder;
  encoder.input_ = std::move(input).value();
  encoder.lstm_ = std::move(lstm).value();
  return encoder;
}

Result<Network> Network::from(const formats::Tensors& tensors, const std::string& prefix,
                              std::string_view source) {
  auto encoder = Encoder::from(tensors, prefix, source);
  if (!encoder.has_value()) {
    return encoder.error();
  }
  auto output = DenseLayer::from(tensors, prefix + "output", num_emissions, 2 * width, source);
  if (!output.has_value()) {
    return output.error();
  }
  Network network;
  network.encoder_ = std::move(encoder).value();
  network.output_ = std::move(output).value();
  return network;
}

namespace {

void add_layer(const DenseLayer& layer, Fnv& hash) {
  for (const std::vector<float>* numbers : {&layer.weight, &layer.bias}) {
    for (const float number : *numbers) {
      hash.add(std::bit_cast<std::uint32_t>(number));
    }
  }
}

template <std::size_t rows, std::size_t columns>
void apply(const DenseLayer& layer, const std::array<std::array<float, columns>, 2>& in,
           std::array<std::array<float, rows>, 2>& out) {
  for (std::size_t first = 0; first < rows; first += tile) {
    std::array<std::array<float, tile>, 2> sum;
    std::copy_n(&layer.bias[first], tile, sum[0].begin());
    sum[1] = sum[0];
    const float* weight = &layer.weight[first * columns];
    for (std::size_t column = 0; column < columns; ++column, weight += tile) {
      for (std::size_t side = 0; side < 2; ++side) {
        for (std::size_t i = 0; i < tile; ++i) {
          sum[side][i] += weight[i] * in[side][column];
        }
      }
    }
    for (std::size_t side = 0; side < 2; ++side) {
      std::copy_n(sum[side].begin(), std::min(tile, rows - first), &out[side][first]);
    }
  }
}

}  // namespace

void Encoder::add_to(Fnv& hash) const {
  add_layer(input_, hash);
  add_layer(lstm_, hash);
}

void Network::add_to(Fnv& hash) const {
  encoder_.add_to(hash);
  add_layer(output_, hash);
}

Encoder::Encoded Encoder::step(const Features& features, State& state) const {
  const std::array<Features, 2> seen{features, intent::mirrored(features)};
  std::array<std::array<float, width>, 2> u;
  apply(input_, seen, u);
  std::array<std::array<float, 2 * width>, 2> in;
  for (std::size_t side = 0; side < 2; ++side) {
    for_each_pack(u[side], [](const Pack& x) { return xsimd::tanh(x); });
    std::copy(u[side].begin(), u[side].end(), in[side].begin());
    std::copy(state.hidden[side].begin(), state.hidden[side].end(), in[side].begin() + width);
  }
  std::array<std::array<float, 4 * width>, 2> gates;
  apply(lstm_, in, gates);
  for (std::size_t side = 0; side < 2; ++side) {
    for (std::size_t i = 0; i < width; i += Pack::size) {
      const auto gate = [&](std::size_t which) {
        return Pack::load_unaligned(&gates[side][which * width + i]);
      };
      const Pack cell = sigmoid(gate(1)) * Pack::load_unaligned(&state.cell[side][i]) +
                        sigmoid(gate(0)) * xsimd::tanh(gate(2));
      const Pack hidden = sigmoid(gate(3)) * xsimd::tanh(cell);
      cell.store_unaligned(&state.cell[side][i]);
      hidden.store_unaligned(&state.hidden[side][i]);
    }
    std::copy(state.hidden[side].begin(), state.hidden[side].end(), in[side].begin());
    std::copy(u[side].begin(), u[side].end(), in[side].begin() + width);
  }
  return in;
}

Emissions Network::step(const Features& features, State& state) const {
  std::array<std::array<float, num_emissions>, 2> out;
  apply(output_, encoder_.step(features, state), out);
  Emissions emissions;
  for (std::size_t h = 0; h < num_horizons; ++h) {
    std::array<Scores, 2> told;
    for (std::size_t side = 0; side < 2; ++side) {
      for (std::size_t k = 0; k < num_classes; ++k) {
        told[side][k] = static_cast<double>(out[side][h * num_classes + k]);
      }
    }
    told[1] = intent::mirrored(told[1]);
    for (std::size_t k = 0; k < num_classes; ++k) {
      emissions[h][k] = std::clamp(0.5 * (told[0][k] + told[1][k]), -largest_score, largest_score);
    }
  }
  return emissions;
}

}  // namespace saca::intent
