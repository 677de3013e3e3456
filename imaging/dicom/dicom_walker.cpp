#include "imaging/dicom/dicom_walker.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <utility>
#include <vector>

#include "common/text/foreign_text.h"

namespace osteomill {

namespace {

constexpr std::uint32_t undefined_length = 0xffffffff;
constexpr std::uint32_t tag(std::uint32_t group, std::uint32_t element) {
    return group << 16U | element;
}
constexpr std::uint32_t item_tag = tag(0xfffe, 0xe000);
constexpr std::uint32_t item_end_tag = tag(0xfffe, 0xe00d);
constexpr std::uint32_t sequence_end_tag = tag(0xfffe, 0xe0dd);
constexpr std::uint32_t pixel_data_tag = tag(0x7fe0, 0x0010);
/// A value that is not taken apart here may be by GDCM. How deep that may go is bounded by the items that
/// could be in it; so many are far from filling a stack.
constexpr std::uint64_t most_items_in_values = 1000;
/// Within an item that states its length, GDCM computes the length of items that do not, several times over
/// at every level. If no item states its length, it need not. Files state all lengths or none.
constexpr std::uint64_t most_effort = std::uint64_t{1} << 21U;
constexpr std::uint64_t effort_of_level = 6;
constexpr int none_open = -1;
/// The index of compressed pixels takes little memory, whatever a file states.
constexpr std::uint32_t most_offset_bytes = 4 * 65536;
constexpr std::size_t most_fragments = std::size_t{1} << 20U;

}  // namespace

std::size_t DicomWalker::walk_file(std::size_t at, const DicomSyntax& syntax,
                                   std::optional<std::uint32_t> only_group) {
    while (at < bytes_.size()) {
        // GDCM judges the bytes behind the pixels, such as a filled-up block.
        if (scan_.has_pixel_data && (bytes_.size() - at < 8 || number<std::uint64_t>(at, false) == 0)) break;
        if (only_group && number<std::uint16_t>(at, false) != *only_group) break;
        const Element element = element_at(at, syntax);
        at = reaches_beyond(element) ? bytes_.size() : after(element, syntax, 0, none_open);
        note(element, syntax);
    }
    return at;
}

void DicomWalker::require_sound() const {
    if (!wrong_representation_.empty()) throw std::invalid_argument(wrong_representation_);
    if (items_in_values_ > most_items_in_values)
        throw std::invalid_argument(fmt::format(
            "is DICOM with {} items within values that are no sequences; damaged", items_in_values_));
}

template <typename T>
T DicomWalker::number(std::size_t at, bool big_endian) const {
    if (at > bytes_.size() || bytes_.size() - at < sizeof(T)) throw DamagedDicom();
    T value = 0;
    for (std::size_t i = 0; i < sizeof(T); ++i)
        value = static_cast<T>(value | static_cast<T>(bytes_[at + i])
                                           << (8U * (big_endian ? sizeof(T) - 1 - i : i)));
    return value;
}

DicomWalker::Element DicomWalker::element_at(std::size_t at, const DicomSyntax& syntax) const {
    Element element;
    element.tag =
        tag(number<std::uint16_t>(at, syntax.big_endian), number<std::uint16_t>(at + 2, syntax.big_endian));
    const bool is_item = element.tag >> 16U == 0xfffe;
    if (!syntax.is_explicit || is_item) {
        element.length = number<std::uint32_t>(at + 4, syntax.big_endian);
        element.value = at + 8;
        return element;
    }
    element.representation = {static_cast<char>(number<std::uint8_t>(at + 4, false)),
                              static_cast<char>(number<std::uint8_t>(at + 5, false))};
    const std::string_view name(element.representation.data(), 2);
    // For any other form GDCM reads a longer length than there is.
    constexpr std::string_view known{
        "AE AS AT CS DA DS DT FD FL IS LO LT OB OD OF OL OV OW PN SH SL SQ SS ST SV TM UC "
        "UI UL UN UR US UT UV"};
    // Old converters write zeros as the form of private elements that they do not know. For "??" and blanks
    // GDCM reads a longer length, too.
    const bool is_nothing = (element.tag >> 16U) % 2 == 1 && name == std::string_view("\0\0", 2);
    if (const std::size_t found = known.find(name);
        !is_nothing && (found == std::string_view::npos || found % 3 != 0))
        throw DamagedDicom(fmt::format("({:04x},{:04x}) is of the unknown form '{}'", element.tag >> 16U,
                                       element.tag & 0xffffU, printable(std::string(name))));
    constexpr std::array<std::string_view, 13> with_long_length{"OB", "OD", "OF", "OL", "OV", "OW", "SQ",
                                                                "SV", "UC", "UN", "UR", "UT", "UV"};
    if (std::find(with_long_length.begin(), with_long_length.end(), name) != with_long_length.end()) {
        element.length = number<std::uint32_t>(at + 8, syntax.big_endian);
        element.value = at + 12;
    } else {
        element.length = number<std::uint16_t>(at + 6, syntax.big_endian);
        element.value = at + 8;
    }
    return element;
}

/// Whether these are uncompressed pixels that the file has and `bytes_` has not, or not all.
bool DicomWalker::reaches_beyond(const Element& element) const {
    const std::uint64_t end = element.value + std::uint64_t{element.length};
    return element.tag == pixel_data_tag && element.length != undefined_length && end > bytes_.size() &&
           end <= file_bytes_;
}

std::size_t DicomWalker::end_of(const Element& element) const {
    if (element.value > bytes_.size() || bytes_.size() - element.value < element.length) throw DamagedDicom();
    return element.value + element.length;
}

bool DicomWalker::is(const Element& element, std::string_view representation) const {
    return std::string_view(element.representation.data(), 2) == representation;
}

/// The offset at which the element ends; walks through the elements nested in it.
std::size_t DicomWalker::after(const Element& element, const DicomSyntax& syntax, int depth,
                               int open_levels) {
    require_representation(element);
    if (element.length == undefined_length) {
        // Also of a picture within a sequence, an icon.
        if (element.tag == pixel_data_tag) return after_fragments(element, syntax, depth == 0);
        // An element of unknown form and length is coded as implicit, whatever the file is.
        const DicomSyntax inner =
            is(element, "UN") ? DicomSyntax{.is_explicit = false, .big_endian = false} : syntax;
        return after_items(element.value, std::nullopt, inner, depth,
                           open_levels == none_open ? none_open : open_levels + 1);
    }
    const std::size_t end = end_of(element);
    const bool is_sequence = is(element, "SQ");
    if (element.tag == pixel_data_tag || (!is_sequence && !begins_with_item(element))) {
        items_in_values_ += items_between(element.value, end);
        return end;
    }
    // If GDCM is asked for a sequence, it accepts any value that begins with an item, in either coding.
    std::vector<DicomSyntax> codings{is_sequence ? syntax : DicomSyntax{.is_explicit = false}};
    if (is_sequence)  // private ones of old scanners are in the other order
        codings.push_back({.is_explicit = syntax.is_explicit, .big_endian = !syntax.big_endian});
    else if (depth == 0)
        codings.push_back({.is_explicit = true});
    const std::uint64_t before = items_in_values_;
    for (const DicomSyntax& coding : codings) {
        try {
            if (after_items(element.value, end, coding, depth, none_open) == end) {
                require_few_hidden(element, items_in_values_ - before);
                return end;
            }
        } catch (const DamagedDicom&) {
            // Its length says where it ends, whatever is in it.
        }
        items_in_values_ = before;
    }
    // GDCM reads it with the file, allocates any length in it, and ends the program if it does not end.
    if (is_sequence && begins_with_item(element)) throw DamagedDicom();
    items_in_values_ += items_between(element.value, end);
    require_few_hidden(element, items_in_values_ - before);
    return end;
}

/// GDCM ends the program if one of those is of another form than the standard's.
void DicomWalker::require_representation(const Element& element) {
    struct Known {
        std::uint32_t tag;
        std::string_view representation;
    };
    constexpr std::array known{
        Known{tag(0x0020, 0x0032), "DS"}, Known{tag(0x0020, 0x0037), "DS"}, Known{tag(0x0028, 0x0002), "US"},
        Known{tag(0x0028, 0x0004), "CS"}, Known{tag(0x0028, 0x0006), "US"}, Known{tag(0x0028, 0x0008), "IS"},
        Known{tag(0x0028, 0x0010), "US"}, Known{tag(0x0028, 0x0011), "US"}, Known{tag(0x0028, 0x0030), "DS"},
        Known{tag(0x0028, 0x0100), "US"}, Known{tag(0x0028, 0x0101), "US"}, Known{tag(0x0028, 0x0102), "US"},
        Known{tag(0x0028, 0x0103), "US"}, Known{tag(0x0028, 0x1052), "DS"}, Known{tag(0x0028, 0x1053), "DS"},
        Known{tag(0x0028, 0x2110), "CS"}};
    const std::string_view name(element.representation.data(), 2);
    if (name[0] == '\0' || name == "UN") return;
    const auto found = std::ranges::find(known, element.tag, &Known::tag);
    if (found != known.end() && found->representation != name && wrong_representation_.empty())
        wrong_representation_ =
            fmt::format("is DICOM whose ({:04x},{:04x}) is of form {} and should be of {}",
                        element.tag >> 16U, element.tag & 0xffffU, name, found->representation);
}

std::uint64_t DicomWalker::effort_of_item(int open_levels) {
    std::uint64_t effort = 1;
    for (int level = 0; level < open_levels; ++level) effort *= effort_of_level;
    return effort;
}

bool DicomWalker::begins_with_item(const Element& element) const {
    return element.length >= 8 && items_between(element.value, element.value + 4) == 1;
}

/// GDCM looks into no private element.
void DicomWalker::require_few_hidden(const Element& element, std::uint64_t items) {
    if ((element.tag >> 16U) % 2 == 0 && items > most_dicom_nesting)
        throw std::invalid_argument(
            fmt::format("is DICOM with {} items in ({:04x},{:04x}) that are no readable sequence; damaged",
                        items, element.tag >> 16U, element.tag & 0xffffU));
}

std::size_t DicomWalker::after_items(std::size_t at, std::optional<std::size_t> end,
                                     const DicomSyntax& syntax, int depth, int open_levels) {
    if (depth >= most_dicom_nesting)
        throw std::invalid_argument(
            fmt::format("is DICOM with more than {} sequences within one another", most_dicom_nesting));
    while (!end || at < *end) {
        const Element item = element_at(at, syntax);
        if (item.tag == sequence_end_tag) return item.value;
        if (item.tag != item_tag) throw DamagedDicom();
        effort_ += effort_of_item(open_levels);
        if (effort_ > most_effort)
            throw std::invalid_argument("is DICOM with too many sequences within one another to be a scan");
        const bool open = item.length == undefined_length;
        const std::size_t item_end = open ? bytes_.size() : end_of(item);
        if (end && !open && item_end > *end) throw DamagedDicom();
        at = item.value;
        bool closed = !open;
        while (at < item_end) {
            const Element element = element_at(at, syntax);
            if (element.tag == item_end_tag) {
                at = element.value;
                closed = true;
                break;
            }
            if (element.tag >> 16U == 0xfffe) throw DamagedDicom();
            at = after(element, syntax, depth + 1, open ? open_levels : 0);
        }
        if (!closed || (!open && at > item_end)) throw DamagedDicom();
    }
    return at;
}

std::size_t DicomWalker::after_fragments(const Element& element, const DicomSyntax& syntax, bool is_noted) {
    std::size_t at = element.value;
    std::size_t first = 0;  // fragment
    for (bool is_table = true;; is_table = false) {
        const Element fragment = element_at(at, syntax);
        if (fragment.tag == sequence_end_tag) return fragment.value;
        if (fragment.tag != item_tag) throw DamagedDicom();
        const std::size_t begin = std::exchange(at, end_of(fragment));
        if (is_table) first = at;
        if (is_noted) is_table ? note_table(fragment) : note_fragment(fragment, begin - first);
    }
}

/// GDCM's codecs end the program if pixels stand where the table of offsets should be.
void DicomWalker::note_table(const Element& table) {
    if (table.length > most_offset_bytes || table.length % 4 != 0 ||
        (table.length != 0 && number<std::uint32_t>(table.value, false) != 0))
        throw std::invalid_argument(
            "has compressed pixel data that do not begin with a table of offsets (7fe0,0010)");
    for (std::size_t at = table.value; at < table.value + table.length; at += 4)
        scan_.frame_offsets.insert(number<std::uint32_t>(at, false));
}

void DicomWalker::note_fragment(const Element& fragment, std::uint64_t at) {
    const Bytes bytes = bytes_.subspan(fragment.value, fragment.length);
    constexpr std::uint32_t most_rle_segments = 15;
    // GDCM's codecs end the program over such fragments, too.
    if (scan_.transfer_syntax == "1.2.840.10008.1.2.5" && !bytes.empty() &&
        (bytes.size() < 64 || number<std::uint32_t>(fragment.value, false) - 1 >= most_rle_segments))
        throw std::invalid_argument("has a fragment of pixel data that is no RLE: damaged");
    if (scan_.pixel_bytes == 0) first_fragment_ = bytes;
    scan_.pixel_bytes += bytes.size();
    const Bytes tail = bytes.last(std::min<std::size_t>(bytes.size(), 4));
    const std::array<std::uint8_t, 2> end{0xff, 0xd9};
    const bool ends = std::search(tail.begin(), tail.end(), end.begin(), end.end()) != tail.end();
    if (scan_.fragments.size() == most_fragments)
        throw std::invalid_argument(fmt::format("has more than {} fragments of pixel data", most_fragments));
    scan_.fragments.push_back({.at = at, .bytes = fragment.length, .ends_picture = ends});
}

/// In either byte order.
std::uint64_t DicomWalker::items_between(std::size_t begin, std::size_t end) const {
    const std::array<std::uint8_t, 4> little{0xfe, 0xff, 0x00, 0xe0};
    const std::array<std::uint8_t, 4> big{0xff, 0xfe, 0xe0, 0x00};
    const Bytes value = bytes_.subspan(begin, end - begin);
    std::uint64_t items = 0;
    for (const auto& pattern : {little, big}) {
        auto at = value.begin();
        while ((at = std::search(at, value.end(), pattern.begin(), pattern.end())) != value.end()) {
            ++items;
            at += 4;
        }
    }
    return items;
}

std::string DicomWalker::text(const Element& element) const {
    const std::size_t length = std::min<std::size_t>(element.length, 64);
    std::string text(reinterpret_cast<const char*>(bytes_.data()) + element.value, length);
    while (!text.empty() && (text.back() == ' ' || text.back() == '\0')) text.pop_back();
    return text;
}

void DicomWalker::note(const Element& element, const DicomSyntax& syntax) {
    if (element.tag == pixel_data_tag) {
        scan_.is_encapsulated = element.length == undefined_length;
        if (!scan_.is_encapsulated) scan_.pixel_bytes = element.length;
        scan_.has_pixel_data = scan_.is_encapsulated || element.length > 0;
        if (scan_.is_encapsulated)
            scan_.codestream = codestream_of(first_fragment_);
        else
            scan_.has_bits_above = has_bits_above(element, syntax.big_endian);
        return;
    }
    if (element.length == undefined_length) return;
    // Overlay Bit Position (60xx,0102); 0 of one that stands beside the pixels.
    if (element.tag >> 24U == 0x60 && (element.tag & 0xffffU) == 0x0102 && element.length >= 2)
        overlay_bits_ |= (1U << number<std::uint16_t>(element.value, syntax.big_endian) % 16U) & ~1U;
    const auto set_text = [&](std::string& into) {
        if (into.empty()) into = text(element);
    };
    const auto set_number = [&](std::optional<int>& into) {
        if (!into && element.length >= 2) into = number<std::uint16_t>(element.value, syntax.big_endian);
    };
    switch (element.tag) {
        case tag(0x0002, 0x0010):
            return set_text(scan_.transfer_syntax);
        case tag(0x0008, 0x0016):
            return set_text(scan_.sop_class);
        case tag(0x0008, 0x0060):
            return set_text(scan_.modality);
        case tag(0x0028, 0x0002):
            return set_number(scan_.samples_per_pixel);
        case tag(0x0028, 0x0008):
            return set_text(scan_.frames);
        case tag(0x0028, 0x0010):
            return set_number(scan_.rows);
        case tag(0x0028, 0x0011):
            return set_number(scan_.columns);
        case tag(0x0028, 0x0100):
            return set_number(scan_.bits_allocated);
        case tag(0x0028, 0x0101):
            return set_number(scan_.bits_stored);
        case tag(0x0028, 0x0102):
            return set_number(scan_.high_bit);
        case tag(0x0028, 0x0103):
            return set_number(scan_.pixel_representation);
        default:
            return;
    }
}

/// Examines the pixels as far as they are among the bytes.
bool DicomWalker::has_bits_above(const Element& pixels, bool big_endian) const {
    const int high = scan_.high_bit.value_or(15);
    if (scan_.bits_allocated != 16 || high >= 15) return false;
    const bool is_signed = scan_.pixel_representation == 1;
    const unsigned above = 0xffffU << (high + 1) & 0xffffU & ~overlay_bits_;
    const unsigned sign = is_signed ? 1U << high : 0U;
    const std::size_t end = std::min<std::size_t>(bytes_.size(), pixels.value + std::size_t{pixels.length});
    for (std::size_t at = pixels.value + 1; at < end; at += 2) {
        const unsigned pixel =
            big_endian ? bytes_[at - 1] << 8U | bytes_[at] : bytes_[at] << 8U | bytes_[at - 1];
        if ((pixel & above) != 0 && ((pixel & sign) == 0 || (pixel & above) != above)) return true;
    }
    return false;
}

}  // namespace osteomill
