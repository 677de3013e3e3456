#include "analysis/hdf5/hdf5_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <type_traits>

namespace osteomill {

namespace {

template <typename Number>
hid_t in_memory() {
    if constexpr (std::is_same_v<Number, double>) return H5T_NATIVE_DOUBLE;
    if constexpr (std::is_same_v<Number, std::int64_t>) return H5T_NATIVE_INT64;
    if constexpr (std::is_same_v<Number, std::uint8_t>) return H5T_NATIVE_UINT8;
}

/// By how much its memory grows.
constexpr std::size_t step_bytes = std::size_t{4} << 20U;

/// In memory: the library does not survive a disk that is full.
Hdf5Id made_in_memory(const std::filesystem::path& name) {
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);  // errors are reported in the program's own lines
    const Hdf5Id access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
    H5Pset_fapl_core(access.get(), step_bytes, 0);
    H5Pset_fclose_degree(access.get(), H5F_CLOSE_STRONG);
    return {H5Fcreate(name.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access.get()), H5Fclose};
}

Hdf5Id scalar() {
    return {H5Screate(H5S_SCALAR), H5Sclose};
}

Hdf5Id row_of(hsize_t size) {
    return {H5Screate_simple(1, &size, nullptr), H5Sclose};
}

}  // namespace

hid_t stored_as(Hdf5Number number) {
    switch (number) {
        case Hdf5Number::i8:
            return H5T_STD_I64LE;
        case Hdf5Number::i4:
            return H5T_STD_I32LE;
        case Hdf5Number::u1:
            return H5T_STD_U8LE;
        case Hdf5Number::f8:
            break;
    }
    return H5T_IEEE_F64LE;
}

Hdf5File::Hdf5File(const std::filesystem::path& file)
    : file_(file), file_id_(made_in_memory(file_.part())), links_(H5Pcreate(H5P_LINK_CREATE), H5Pclose) {
    check(file_id_.get());
    check(H5Pset_create_intermediate_group(links_.get(), 1));
}

void Hdf5File::fail() const {
    const int reason = errno;
    throw std::runtime_error(
        fmt::format("{}: cannot write: {}", file_.path().string(),
                    reason != 0 ? std::strerror(reason) : "the HDF5 library refuses it"));
}

Hdf5Id Hdf5File::dataset_properties() const {
    Hdf5Id properties(check(H5Pcreate(H5P_DATASET_CREATE)), H5Pclose);
    check(H5Pset_obj_track_times(properties.get(), 0));
    return properties;
}

Hdf5Id Hdf5File::text_type() const {
    Hdf5Id type(check(H5Tcopy(H5T_C_S1)), H5Tclose);
    check(H5Tset_size(type.get(), H5T_VARIABLE));
    check(H5Tset_cset(type.get(), H5T_CSET_UTF8));
    return type;
}

void Hdf5File::add_group(const std::string& path) {
    errno = 0;
    const Hdf5Id group(check(H5Gcreate2(id(), path.c_str(), links_.get(), H5P_DEFAULT, H5P_DEFAULT)),
                       H5Gclose);
}

void Hdf5File::add_text(const std::string& path, const std::string& text) {
    const char* bytes = text.c_str();
    add_dataset(path, text_type().get(), scalar(), &bytes);
}

void Hdf5File::add_texts(const std::string& path, const std::vector<std::string>& texts) {
    std::vector<const char*> bytes;
    for (const std::string& text : texts) bytes.push_back(text.c_str());
    add_dataset(path, text_type().get(), row_of(texts.size()), bytes.data());
}

void Hdf5File::add_number(const std::string& path, double value) {
    add_dataset(path, H5T_NATIVE_DOUBLE, scalar(), &value);
}

void Hdf5File::add_dataset(const std::string& path, hid_t type, const Hdf5Id& space, const void* values) {
    errno = 0;
    const Hdf5Id dataset(check(H5Dcreate2(id(), path.c_str(), type, check(space.get()), links_.get(),
                                          dataset_properties().get(), H5P_DEFAULT)),
                         H5Dclose);
    if (H5Sget_simple_extent_npoints(space.get()) > 0)
        check(H5Dwrite(dataset.get(), type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values));
}

void Hdf5File::add_link(const std::string& path, const std::filesystem::path& file,
                        const std::string& target) {
    errno = 0;
    check(H5Lcreate_external(file.c_str(), target.c_str(), id(), path.c_str(), links_.get(), H5P_DEFAULT));
}

void Hdf5File::set_attribute(const std::string& path, const std::string& name, const std::string& text) {
    const char* bytes = text.c_str();
    set_attribute(path, name, text_type().get(), scalar(), &bytes);
}

void Hdf5File::set_attribute(const std::string& path, const std::string& name,
                             std::span<const double> numbers) {
    set_attribute(path, name, H5T_NATIVE_DOUBLE, row_of(numbers.size()), numbers.data());
}

void Hdf5File::set_attribute(const std::string& path, const std::string& name, double number) {
    set_attribute(path, name, H5T_NATIVE_DOUBLE, scalar(), &number);
}

void Hdf5File::set_attribute(const std::string& path, const std::string& name, hid_t type,
                             const Hdf5Id& space, const void* value) {
    errno = 0;
    const Hdf5Id attribute(check(H5Acreate_by_name(id(), path.c_str(), name.c_str(), type, space.get(),
                                                   H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT)),
                           H5Aclose);
    check(H5Awrite(attribute.get(), type, value));
}

void Hdf5File::commit() {
    errno = 0;
    check(H5Fflush(id(), H5F_SCOPE_LOCAL));
    void* bytes = nullptr;
    check(H5Fget_vfd_handle(id(), H5P_DEFAULT, &bytes));
    const auto size = check(H5Fget_file_image(id(), nullptr, 0));  // less than its memory
    file_.write({*static_cast<const std::byte* const*>(bytes), static_cast<std::size_t>(size)});
    check(file_id_.close());
    file_.commit();
}

template <typename Number>
Hdf5Series<Number>::Hdf5Series(Hdf5File& file, const std::string& path, Hdf5Number stored,
                               const std::string& units, std::size_t width)
    : file_(file), row_numbers_(std::max<std::size_t>(width, 1)), rank_(width == 0 ? 1 : 2) {
    errno = 0;
    const std::array<hsize_t, 2> none{0, width};
    const std::array<hsize_t, 2> most{H5S_UNLIMITED, width};
    const std::array<hsize_t, 2> chunk{chunk_rows, width};
    const Hdf5Id space(file.check(H5Screate_simple(rank_, none.data(), most.data())), H5Sclose);
    const Hdf5Id properties = file.dataset_properties();
    file.check(H5Pset_chunk(properties.get(), rank_, chunk.data()));
    file.check(H5Pset_shuffle(properties.get()));
    file.check(H5Pset_deflate(properties.get(), gzip_level));
    dataset_ = Hdf5Id(file.check(H5Dcreate2(file.id(), path.c_str(), stored_as(stored), space.get(),
                                            file.link_properties(), properties.get(), H5P_DEFAULT)),
                      H5Dclose);
    waiting_.reserve(chunk_rows * row_numbers_);
    if (!units.empty()) file.set_attribute(path, "units", units);
}

template <typename Number>
void Hdf5Series<Number>::add(std::span<const Number> numbers) {
    waiting_.insert(waiting_.end(), numbers.begin(), numbers.end());
    if (waiting_.size() < chunk_rows * row_numbers_) return;
    // Whole chunks are compressed once.
    const std::size_t whole = waiting_.size() / (chunk_rows * row_numbers_) * (chunk_rows * row_numbers_);
    std::vector<Number> rest(waiting_.begin() + static_cast<std::ptrdiff_t>(whole), waiting_.end());
    waiting_.resize(whole);
    write_waiting();
    waiting_ = std::move(rest);
}

template <typename Number>
void Hdf5Series<Number>::close() {
    write_waiting();
    file_.check(dataset_.close());
}

template <typename Number>
void Hdf5Series<Number>::write_waiting() {
    if (waiting_.empty()) return;
    errno = 0;
    const std::array<hsize_t, 2> first{rows_, 0};
    const std::array<hsize_t, 2> count{waiting_.size() / row_numbers_, row_numbers_};
    const std::array<hsize_t, 2> size{rows_ + count[0], row_numbers_};
    file_.check(H5Dset_extent(dataset_.get(), size.data()));
    const Hdf5Id in_file(file_.check(H5Dget_space(dataset_.get())), H5Sclose);
    file_.check(
        H5Sselect_hyperslab(in_file.get(), H5S_SELECT_SET, first.data(), nullptr, count.data(), nullptr));
    const Hdf5Id rows(file_.check(H5Screate_simple(rank_, count.data(), nullptr)), H5Sclose);
    file_.check(H5Dwrite(dataset_.get(), in_memory<Number>(), rows.get(), in_file.get(), H5P_DEFAULT,
                         waiting_.data()));
    rows_ = size[0];
    waiting_.clear();
}

template class Hdf5Series<double>;
template class Hdf5Series<std::int64_t>;
template class Hdf5Series<std::uint8_t>;

}  // namespace osteomill
