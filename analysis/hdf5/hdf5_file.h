// An HDF5 file under way: groups, series of rows that grow, attributes. It is made in memory, compressed, and
// takes the place of an older file once it is whole (atomic_file.h); a failure is one line with the file and
// the reason.
#pragma once

#include <hdf5.h>

#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "common/files/atomic_file.h"

namespace osteomill {

/// The usual one, which FIVRS's recordings have, too.
inline constexpr unsigned gzip_level = 4;

/// A handle of the library, closed once.
class Hdf5Id {
  public:
    using Close = herr_t (*)(hid_t);
    Hdf5Id() = default;
    Hdf5Id(hid_t id, Close how) : id_(id), close_(how) {}
    Hdf5Id(Hdf5Id&& other) noexcept : id_(std::exchange(other.id_, H5I_INVALID_HID)), close_(other.close_) {}
    Hdf5Id& operator=(Hdf5Id&& other) noexcept {
        std::swap(id_, other.id_);
        std::swap(close_, other.close_);
        return *this;
    }
    ~Hdf5Id() { close(); }

    hid_t get() const { return id_; }
    herr_t close() { return id_ < 0 ? 0 : close_(std::exchange(id_, H5I_INVALID_HID)); }

  private:
    hid_t id_ = H5I_INVALID_HID;
    Close close_ = nullptr;
};

/// How numbers lie in the file, little endian.
enum class Hdf5Number { f8, i8, i4, u1 };
hid_t stored_as(Hdf5Number number);

/// Nothing here is called from two threads at once. Failures throw std::runtime_error in one line.
class Hdf5File {
  public:
    explicit Hdf5File(const std::filesystem::path& file);

    /// With the groups above it.
    void add_group(const std::string& path);
    void add_text(const std::string& path, const std::string& text);
    void add_texts(const std::string& path, const std::vector<std::string>& texts);
    void add_number(const std::string& path, double value);
    /// Links to `target` in another file, which is found beside this one.
    void add_link(const std::string& path, const std::filesystem::path& file, const std::string& target);
    /// Sets an attribute of a group or dataset that is there; "/" is the file.
    void set_attribute(const std::string& path, const std::string& name, const std::string& text);
    void set_attribute(const std::string& path, const std::string& name, std::span<const double> numbers);
    void set_attribute(const std::string& path, const std::string& name, double number);

    /// Writes all and makes it the file. Every series is to be closed before.
    void commit();

    const std::filesystem::path& path() const { return file_.path(); }
    hid_t id() const { return file_id_.get(); }
    /// Passes the library's result on, unless that is a failure.
    template <typename Result>
    Result check(Result result) const {
        if (result < 0) fail();
        return result;
    }
    /// Properties of a dataset's link: missing groups above it are made.
    hid_t link_properties() const { return links_.get(); }
    /// Properties of a dataset: it stores no time of creation, so that the same content makes the same bytes.
    Hdf5Id dataset_properties() const;

  private:
    [[noreturn]] void fail() const;
    Hdf5Id text_type() const;
    void add_dataset(const std::string& path, hid_t type, const Hdf5Id& space, const void* values);
    void set_attribute(const std::string& path, const std::string& name, hid_t type, const Hdf5Id& space,
                       const void* value);

    AtomicFile file_;
    Hdf5Id file_id_;
    Hdf5Id links_;
};

/// A dataset that rows are added to: rows of one number, or of `width` numbers. In chunks, gzip.
template <typename Number>
class Hdf5Series {
  public:
    /// `units`: an attribute of that name; empty: none. The file outlives it.
    Hdf5Series(Hdf5File& file, const std::string& path, Hdf5Number stored, const std::string& units = {},
               std::size_t width = 0);

    void add(Number value) { add(std::span(&value, 1)); }
    template <std::size_t size>
    void add(const std::array<Number, size>& row) {
        add(std::span<const Number>(row));
    }
    /// A row, or several in a row.
    void add(std::span<const Number> numbers);
    std::uint64_t rows() const { return rows_ + waiting_.size() / row_numbers_; }
    /// Writes the rows that still wait.
    void close();

  private:
    static constexpr std::size_t chunk_rows = 4096;
    void write_waiting();

    Hdf5File& file_;
    std::size_t row_numbers_;
    int rank_;
    Hdf5Id dataset_;
    std::vector<Number> waiting_;
    std::uint64_t rows_ = 0;  // in the file
};

/// Several series, closed together.
template <typename Number>
class Hdf5Table {
  public:
    explicit Hdf5Table(Hdf5File& file) : file_(file) {}
    Hdf5Series<Number>& add(const std::string& path, Hdf5Number stored, const std::string& units = {},
                            std::size_t width = 0) {
        return series_.try_emplace(path, file_, path, stored, units, width).first->second;
    }
    Hdf5Series<Number>& at(const std::string& path) { return series_.at(path); }
    void close() {
        for (auto& [path, series] : series_) series.close();
    }

  private:
    Hdf5File& file_;
    std::map<std::string, Hdf5Series<Number>> series_;
};

}  // namespace osteomill
