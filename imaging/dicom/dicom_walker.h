// Walk through the elements of a DICOM file, with bounds on nesting and effort; it collects the facts of
// dicom_precheck.h.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>

#include "imaging/dicom/dicom_precheck.h"

namespace osteomill {

struct DamagedDicom : std::invalid_argument {
    explicit DamagedDicom(const std::string& why = "cut off or damaged")
        : std::invalid_argument("is DICOM but cannot be parsed: " + why) {}
};

/// The part of a transfer syntax that says how elements are coded.
struct DicomSyntax {
    bool is_explicit = true;
    bool big_endian = false;
};

class DicomWalker {
  public:
    using Bytes = std::span<const std::uint8_t>;

    /// `bytes` outlive it; they may be the first of a file of `file_bytes`.
    DicomWalker(Bytes bytes, std::uint64_t file_bytes) : bytes_(bytes), file_bytes_(file_bytes) {}

    /// The elements met so far.
    const DicomScan& scan() const { return scan_; }

    /// Elements of the file itself, from an offset on, up to one of another group where `only_group` is one.
    /// Returns the offset of the end. Throws as scan_dicom does.
    std::size_t walk_file(std::size_t at, const DicomSyntax& syntax, std::optional<std::uint32_t> only_group);
    /// Throws std::invalid_argument if values that are no sequences hold many items, or an element is of
    /// another form than the standard's.
    void require_sound() const;

  private:
    struct Element {
        std::uint32_t tag = 0;
        std::array<char, 2> representation{};  // "SQ"; zeros when implicit
        std::uint32_t length = 0;
        std::size_t value = 0;  // where it begins
    };

    template <typename T>
    T number(std::size_t at, bool big_endian) const;
    Element element_at(std::size_t at, const DicomSyntax& syntax) const;
    bool reaches_beyond(const Element& element) const;
    std::size_t end_of(const Element& element) const;
    bool is(const Element& element, std::string_view representation) const;
    std::size_t after(const Element& element, const DicomSyntax& syntax, int depth, int open_levels);
    static std::uint64_t effort_of_item(int open_levels);
    bool begins_with_item(const Element& element) const;
    static void require_few_hidden(const Element& element, std::uint64_t items);
    std::size_t after_items(std::size_t at, std::optional<std::size_t> end, const DicomSyntax& syntax,
                            int depth, int open_levels);
    void require_representation(const Element& element);
    void note_table(const Element& table);
    void note_fragment(const Element& fragment, std::uint64_t at);
    std::size_t after_fragments(const Element& element, const DicomSyntax& syntax, bool is_noted);
    std::uint64_t items_between(std::size_t begin, std::size_t end) const;
    std::string text(const Element& element) const;
    void note(const Element& element, const DicomSyntax& syntax);
    bool has_bits_above(const Element& pixels, bool big_endian) const;

    Bytes bytes_;
    std::uint64_t file_bytes_;
    DicomScan scan_;
    Bytes first_fragment_;
    unsigned overlay_bits_ = 0;         // bits of a pixel
    std::string wrong_representation_;  // message about the first element that has one
    std::uint64_t items_in_values_ = 0;
    std::uint64_t effort_ = 0;
};

}  // namespace osteomill
