// Values of a GDCM data set, as text and numbers. Only the sources of this folder see it.
#pragma once

#include <fmt/format.h>
#include <gdcmDataSet.h>
#include <gdcmSequenceOfItems.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "common/text/foreign_text.h"

namespace osteomill {

/// An element's bytes as text, without padding; empty if absent.
inline std::string text_of(const gdcm::DataSet& data, const gdcm::Tag& tag) {
    if (!data.FindDataElement(tag)) return {};
    const gdcm::ByteValue* bytes = data.GetDataElement(tag).GetByteValue();
    if (bytes == nullptr || bytes->GetPointer() == nullptr) return {};
    std::string text(bytes->GetPointer(), bytes->GetLength());
    while (!text.empty() && (text.back() == ' ' || text.back() == '\0')) text.pop_back();
    return text;
}

/// An unsigned 16-bit number; GDCM hands its bytes over in the machine's order.
inline std::optional<std::uint16_t> number_of(const gdcm::DataSet& data, const gdcm::Tag& tag) {
    if (!data.FindDataElement(tag)) return std::nullopt;
    const gdcm::ByteValue* bytes = data.GetDataElement(tag).GetByteValue();
    if (bytes == nullptr || bytes->GetLength() < 2) return std::nullopt;
    std::uint16_t number = 0;
    std::copy_n(bytes->GetPointer(), 2, reinterpret_cast<char*>(&number));
    return number;
}

/// "a\b\c" as exactly `count` numbers. Throws std::invalid_argument for "1,5", which is no number of DICOM.
template <std::size_t count>
std::optional<std::array<double, count>> numbers_of(const gdcm::DataSet& data, const gdcm::Tag& tag) {
    std::istringstream text(text_of(data, tag));
    std::array<double, count> numbers{};
    for (double& number : numbers) {
        std::string part;
        if (!std::getline(text, part, '\\')) return std::nullopt;
        char* end = nullptr;
        number = std::strtod(part.c_str(), &end);
        if (end == part.c_str()) return std::nullopt;
        if (*end == ',')
            throw std::invalid_argument(
                fmt::format("({:04x},{:04x}) is '{}', no numbers as DICOM writes them, "
                            "with a point",
                            tag.GetGroup(), tag.GetElement(), printable(text.str().substr(0, 40))));
    }
    return numbers;
}

/// The first item of a sequence, such as a functional group; null if there is none.
inline gdcm::SmartPointer<gdcm::SequenceOfItems> sequence_of(const gdcm::DataSet& data,
                                                             const gdcm::Tag& tag) {
    if (!data.FindDataElement(tag)) return nullptr;
    return data.GetDataElement(tag).GetValueAsSQ();
}

/// Places that a value may stand in: the frame's own group, the one shared by all frames, the file itself.
struct Places {
    std::vector<const gdcm::DataSet*> in;
    template <std::size_t count>
    std::optional<std::array<double, count>> find(const gdcm::Tag& group, const gdcm::Tag& tag) const {
        for (const gdcm::DataSet* data : in) {
            if (const auto groups = sequence_of(*data, group); groups && groups->GetNumberOfItems() > 0)
                if (const auto found = numbers_of<count>(groups->GetItem(1).GetNestedDataSet(), tag))
                    return found;
            if (const auto found = numbers_of<count>(*data, tag)) return found;
        }
        return std::nullopt;
    }
};

/// The functional groups of a multi-frame file: statements about its frames.
class FrameGroups {
  public:
    explicit FrameGroups(const gdcm::DataSet& data)
        : data_(data),
          shared_(sequence_of(data, {0x5200, 0x9229})),
          per_frame_(sequence_of(data, {0x5200, 0x9230})) {}

    /// Frames that have a group of their own.
    std::size_t count() const { return per_frame_ ? per_frame_->GetNumberOfItems() : 0; }
    Places of(std::size_t frame) const {
        Places places;
        if (count() > 0) places.in.push_back(&per_frame_->GetItem(frame + 1).GetNestedDataSet());
        if (shared_ && shared_->GetNumberOfItems() > 0)
            places.in.push_back(&shared_->GetItem(1).GetNestedDataSet());
        places.in.push_back(&data_);
        return places;
    }

  private:
    const gdcm::DataSet& data_;
    gdcm::SmartPointer<gdcm::SequenceOfItems> shared_;
    gdcm::SmartPointer<gdcm::SequenceOfItems> per_frame_;
};

}  // namespace osteomill
