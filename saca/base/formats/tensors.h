#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "saca/base/core/file.h"
#include "saca/base/core/fnv.h"
#include "saca/base/core/result.h"

namespace saca::formats {

/// Numbers in rows, the last index fastest.
struct Tensor {
  std::vector<std::size_t> shape;  ///< each >= 1; empty: one number
  std::vector<float> values;       ///< as many as the shape says, finite
};

/// A file of named tensors, with words about it.
struct Tensors {
  std::map<std::string, std::string> words;
  std::map<std::string, Tensor> tensors;
};

/// The tensors of a safetensors file; float32 (`F32`) only.
///
/// @param source  name for messages, usually the path
/// @return        Error::Code::malformed, naming source, tensor, wanted and got: other types,
/// numbers
///                that are not finite, offsets that leave a gap, overlap or end outside of the file
/// Source: Hugging Face, safetensors, README, section Format (little-endian: 8 bytes of size, JSON,
/// numbers).
[[nodiscard]] Result<Tensors> read_tensors(std::string_view bytes, std::string_view source);

/// Those of a file of at most so many bytes.
/// @return  likewise, or as read_file
[[nodiscard]] Result<Tensors> read_tensor_file(const std::filesystem::path& path,
                                               std::uintmax_t most = usual_bytes);

/// The same tensors make the same bytes.
/// @throws ContractViolation  if a tensor has not as many numbers as its shape says
[[nodiscard]] std::string tensor_bytes(const Tensors& tensors);

/// The tensor's numbers, which must have this shape.
/// @return  Error::Code::malformed, naming source, tensor, wanted and got
[[nodiscard]] Result<std::vector<float>> take(const Tensors& tensors, const std::string& name,
                                              const std::vector<std::size_t>& shape,
                                              std::string_view source);

/// Weights of one layer of a network, and what is added.
struct Layer {
  std::size_t rows = 0;
  std::size_t columns = 0;
  std::vector<float> weight;  ///< [row][column]
  std::vector<float> bias;    ///< [row]

  /// Adds all its numbers, to name them.
  void add_to(Fnv& hash) const;
};

/// The tensors `name`.weight (rows x columns) and `name`.bias (rows).
/// @return  likewise
[[nodiscard]] Result<Layer> take_layer(const Tensors& tensors, const std::string& name,
                                       std::size_t rows, std::size_t columns,
                                       std::string_view source);

}  // namespace saca::formats
