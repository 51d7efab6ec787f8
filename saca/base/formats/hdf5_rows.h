#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "saca/base/formats/hdf5_reader.h"
#include "saca/base/formats/hdf5_writer.h"

namespace saca::formats {

// Tables in an HDF5 file: each column a row of numbers, or a text of one line per entry. What is
// read wrongly is remembered by the reader; what is returned then has the size that was asked for.

/// @param row  at least one number
void write_row(Hdf5Writer& writer, const char* name, const std::vector<double>& row);

/// @throws ContractViolation  if a line holds the end of a line
void write_lines(Hdf5Writer& writer, const char* name, std::span<const std::string> lines);

/// How many numbers stand in a row; 0 after a problem.
[[nodiscard]] std::size_t row_size(Hdf5Reader& reader, const char* name);

[[nodiscard]] std::vector<double> read_row(Hdf5Reader& reader, const char* name, std::size_t size,
                                           Numbers allowed = Numbers::finite);

/// Whole numbers in [least, 2^53].
[[nodiscard]] std::vector<std::size_t> read_counts(Hdf5Reader& reader, const char* name,
                                                   std::size_t size, std::size_t least);

/// Likewise, which must add up to `sum`.
[[nodiscard]] std::vector<std::size_t> read_parts(Hdf5Reader& reader, const char* name,
                                                  std::size_t size, std::size_t least,
                                                  std::size_t sum);

/// Numbers that are 0 or 1.
[[nodiscard]] std::vector<bool> read_flags(Hdf5Reader& reader, const char* name, std::size_t size);

[[nodiscard]] std::vector<std::string> read_lines(Hdf5Reader& reader, const char* name,
                                                  std::size_t size);

}  // namespace saca::formats
