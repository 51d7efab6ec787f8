#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "saca/base/core/result.h"

namespace saca::model_host {

/// Adds a trained adapter (LoRA; a GGUF file of type adapter, as llama.cpp has it) to a model's
/// weights, once for all: W + alpha / r B A for each matrix W that the adapter has a pair A, B for.
///
/// @param base         a GGUF file; its quantised matrices are taken as what they stand for
/// @param base_sha256  of that file, in hex: the adapter must name the same
/// @param adapter      its matrices in llama.cpp's order of rows
/// @param out          the merged matrices in 16 bits, which it names as its type; everything else
///                     as it was; written whole or not at all
/// @return             nullopt, or what is wrong and where: unreadable, malformed (no adapter, or
///                     of another base), unwritable
[[nodiscard]] std::optional<Error> merge_adapter(const std::string& base,
                                                 std::string_view base_sha256,
                                                 const std::string& adapter,
                                                 const std::string& out);

}  // namespace saca::model_host
