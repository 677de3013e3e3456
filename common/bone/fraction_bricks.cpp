#include "common/bone/fraction_bricks.h"

namespace osteomill {

namespace {

std::vector<ByteBrick*> places_in(std::vector<ByteBrick>& block) {
    std::vector<ByteBrick*> places;
    places.reserve(block.size());
    for (ByteBrick& brick : block) places.push_back(&brick);
    return places;
}

}  // namespace

FractionBricks::FractionBricks(std::vector<ByteBrick> bricks)
    : block_(std::make_shared<std::vector<ByteBrick>>(std::move(bricks))), places_(places_in(*block_)) {}

FractionBricks::FractionBricks(const FractionBricks& other)
    : block_(other.block_), is_shared_(other.is_shared_), places_(other.places_) {
    if (block_ == nullptr) return;  // of one that was moved from
    if (!is_shared_) {
        block_ = std::make_shared<std::vector<ByteBrick>>(*block_);
        places_ = places_in(*block_);
        return;
    }
    own_.reserve(other.own_.size());
    for (const auto& [slot, brick] : other.own_) {
        own_.emplace_back(slot, std::make_unique<ByteBrick>(*brick));
        places_[slot] = own_.back().second.get();
    }
}

FractionBricks& FractionBricks::operator=(FractionBricks other) noexcept {
    std::swap(block_, other.block_);
    std::swap(is_shared_, other.is_shared_);
    std::swap(own_, other.own_);
    std::swap(places_, other.places_);
    return *this;
}

void FractionBricks::share() {
    if (is_shared_ && own_.empty()) return;
    if (is_shared_) {
        std::vector<ByteBrick> bricks;
        bricks.reserve(places_.size());
        for (const ByteBrick* brick : places_) bricks.push_back(*brick);
        *this = FractionBricks(std::move(bricks));
    }
    is_shared_ = true;
}

void FractionBricks::make_own(std::size_t slot) {
    own_.emplace_back(slot, std::make_unique<ByteBrick>(*places_[slot]));
    places_[slot] = own_.back().second.get();
}

}  // namespace osteomill
