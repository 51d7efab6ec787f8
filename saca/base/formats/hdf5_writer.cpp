#include "saca/base/formats/hdf5_writer.h"

#include <algorithm>

#include "saca/base/formats/hdf5_handle.h"

namespace saca::formats {
namespace {

constexpr hsize_t chunk_numbers = 1 << 16;  // 256 or 512 KiB at a time
constexpr unsigned deflate_level = 1;       // higher ones are far slower and save a few per cent

Hdf5Handle text_type(std::size_t size) {
  Hdf5Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
  H5Tset_size(type.id(), std::max<std::size_t>(size, 1));  // none may be empty
  H5Tset_strpad(type.id(), H5T_STR_NULLPAD);
  H5Tset_cset(type.id(), H5T_CSET_UTF8);
  return type;
}

/// A data set that does not note when it was made: the same values make the same file.
Hdf5Handle timeless() {
  Hdf5Handle layout(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
  H5Pset_obj_track_times(layout.id(), false);
  return layout;
}
Hdf5Handle chunked(const std::vector<hsize_t>& extents) {
  std::vector<hsize_t> chunk(extents.size(), 1);
  hsize_t room = chunk_numbers;
  for (std::size_t d = extents.size(); d-- > 0 && room > 1; room /= chunk[d]) {
    chunk[d] = std::min(extents[d], room);
  }
  Hdf5Handle layout = timeless();
  H5Pset_chunk(layout.id(), static_cast<int>(chunk.size()), chunk.data());
  H5Pset_shuffle(layout.id());
  H5Pset_deflate(layout.id(), deflate_level);
  return layout;
}

}  // namespace

struct Hdf5Writer::State {
  explicit State(std::size_t growth) : access(memory_file_access(growth)) {}

  Hdf5Session session;
  Hdf5Handle access;
  Hdf5Handle file{H5Fcreate("in memory", H5F_ACC_TRUNC, H5P_DEFAULT, access.id()), H5Fclose};
  bool good = true;

  void note(bool went_well) { good = good && went_well; }

  void attribute(const std::string& object, const char* name, hid_t stored, hid_t given,
                 const void* value) {
    const Hdf5Handle space(H5Screate(H5S_SCALAR), H5Sclose);
    const Hdf5Handle made(H5Acreate_by_name(file.id(), object.c_str(), name, stored, space.id(),
                                            H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
                          H5Aclose);
    note(made.good() && H5Awrite(made.id(), given, value) >= 0);
  }
};

Hdf5Writer::Hdf5Writer(std::size_t growth) : state_(std::make_unique<State>(growth)) {}
Hdf5Writer::~Hdf5Writer() = default;

void Hdf5Writer::group(const std::string& name) {
  const Hdf5Handle made(
      H5Gcreate2(state_->file.id(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Gclose);
  state_->note(made.good());
}

void Hdf5Writer::attribute(const std::string& object, const char* name, double value) {
  state_->attribute(object, name, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, &value);
}
void Hdf5Writer::attribute(const std::string& object, const char* name, std::int32_t value) {
  state_->attribute(object, name, H5T_STD_I32LE, H5T_NATIVE_INT32, &value);
}
void Hdf5Writer::attribute(const std::string& object, const char* name, const std::string& text) {
  const Hdf5Handle type = text_type(text.size());
  state_->attribute(object, name, type.id(), type.id(), text.c_str());
}

void Hdf5Writer::text(const char* name, const std::string& text) {
  const Hdf5Handle type = text_type(text.size());
  const Hdf5Handle space(H5Screate(H5S_SCALAR), H5Sclose);
  const Hdf5Handle layout = timeless();
  const Hdf5Handle set(H5Dcreate2(state_->file.id(), name, type.id(), space.id(), H5P_DEFAULT,
                                  layout.id(), H5P_DEFAULT),
                       H5Dclose);
  state_->note(set.good() &&
               H5Dwrite(set.id(), type.id(), H5S_ALL, H5S_ALL, H5P_DEFAULT, text.c_str()) >= 0);
}

template <class Real>
void Hdf5Writer::numbers(const char* name, const std::vector<std::size_t>& extents,
                         const std::vector<const Real*>& parts) {
  Hdf5Parts along(extents, parts.size());
  const std::vector<hsize_t> shape(extents.begin(), extents.end());
  const Hdf5Handle space(H5Screate_simple(static_cast<int>(shape.size()), shape.data(), nullptr),
                         H5Sclose);
  const Hdf5Handle layout = chunked(shape);
  const Hdf5Handle set(H5Dcreate2(state_->file.id(), name, file_type<Real>(), space.id(),
                                  H5P_DEFAULT, layout.id(), H5P_DEFAULT),
                       H5Dclose);
  state_->note(space.good() && set.good());
  const Hdf5Handle part_space = along.space();
  for (const Real* const part : parts) {
    state_->note(along.select_next(space) &&
                 H5Dwrite(set.id(), memory_type<Real>(), part_space.id(), space.id(), H5P_DEFAULT,
                          part) >= 0);
  }
}

std::optional<std::string_view> Hdf5Writer::bytes() {
  const hid_t file = state_->file.id();
  state_->note(H5Fflush(file, H5F_SCOPE_GLOBAL) >= 0);
  const ssize_t size = state_->good ? H5Fget_file_image(file, nullptr, 0) : -1;
  void* address = nullptr;  // of a pointer to where the file lies
  if (size <= 0 || H5Fget_vfd_handle(file, state_->access.id(), &address) < 0) {
    return std::nullopt;
  }
  return std::string_view(*static_cast<const char* const*>(address),
                          static_cast<std::size_t>(size));
}

template void Hdf5Writer::numbers(const char*, const std::vector<std::size_t>&,
                                  const std::vector<const float*>&);
template void Hdf5Writer::numbers(const char*, const std::vector<std::size_t>&,
                                  const std::vector<const double*>&);

}  // namespace saca::formats
