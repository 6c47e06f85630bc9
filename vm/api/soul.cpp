#include "vm/api/soul.h"

#include "protocol/payload.h"

#include <algorithm>
#include <vector>

namespace orb::vm {
namespace {

using namespace spec::ball;

constexpr std::uint8_t block_version = 1;

} // namespace

std::optional<std::uint32_t> Soul::refill(std::uint8_t bank) {
  if (cores_ < refill_cost)
    return std::nullopt;
  cores_ -= refill_cost;
  (bank == spec::bank::boost ? boost_ : shield_) = full;
  return cores_;
}

bool Soul::buy(std::uint8_t consumable, std::uint8_t quantity) {
  const std::uint32_t cost = consumable_cost * quantity;
  auto& count = consumables_[consumable];
  if (cores_ < cost || count + quantity > UINT8_MAX)
    return false;
  cores_ -= cost;
  count = static_cast<std::uint8_t>(count + quantity);
  return true;
}

bool Soul::use(std::uint8_t consumable) {
  auto& count = consumables_[consumable];
  if (count == 0)
    return false;
  --count;
  return true;
}

bool Soul::start_boost() {
  boosting_ = boost_ > 0;
  return boosting_;
}

bool Soul::damage_shield() {
  if (shield_ == 0)
    return false;
  shield_ = std::max(0, shield_ - shield_damage);
  return true;
}

bool Soul::changing() const {
  return boosting_ || boost_ < full || shield_ < full;
}

Soul::Changes Soul::tick(bool moving) {
  Changes changes;
  const auto boost_before = boost_;
  const auto shield_before = shield_;
  const auto experience_before = experience();
  boost_ = std::clamp(boost_ + (boosting_ ? -boost_drain : boost_growth), 0, full);
  boosting_ = boosting_ && boost_ > 0;
  shield_ = std::min(full, shield_ + shield_growth);
  if (moving && ++drive_s_ >= level_time * std::uint32_t{level_}) {
    drive_s_ = 0;
    ++level_;
    points_ = static_cast<std::uint16_t>(points_ + points_per_level);
    changes.level = true;
  }
  changes.boost = boost_ != boost_before;
  changes.shield = shield_ != shield_before;
  changes.experience = experience() != experience_before;
  return changes;
}

std::uint8_t Soul::experience() const {
  return static_cast<std::uint8_t>(
      std::min<std::uint32_t>(full, drive_s_ * full / (level_time * std::uint32_t{level_})));
}

Bytes Soul::block() const {
  std::vector<protocol::FieldContent> contents{block_version, cores_,  level_,  points_,
                                               drive_s_,      boost(), shield()};
  contents.insert(contents.end(), consumables_.begin(), consumables_.end());
  contents.insert(contents.end(), attributes_.begin(), attributes_.end());
  auto out = protocol::write_fields(spec::soul_fields(), contents);
  out.resize(spec::ssb_size);
  return out;
}

bool Soul::load(ByteView block) {
  namespace at = spec::soul_at;
  if (block.size() != spec::ssb_size)
    return false;
  const auto fields = protocol::read_fields(spec::soul_fields(), block);
  const auto number = [&](std::size_t field) {
    return static_cast<std::uint32_t>(fields[field].number);
  };
  if (number(at::Version) != block_version || number(at::Level) == 0)
    return false;
  cores_ = number(at::Cores);
  level_ = static_cast<std::uint16_t>(number(at::Level));
  points_ = static_cast<std::uint16_t>(number(at::Points));
  drive_s_ = std::min(number(at::DriveTime), level_time * std::uint32_t{level_} - 1);
  boost_ = static_cast<int>(number(at::Boost));
  shield_ = static_cast<int>(number(at::Shield));
  for (std::size_t i = 0; i < consumables_.size(); ++i)
    consumables_[i] = static_cast<std::uint8_t>(number(at::FirstConsumable + i));
  for (std::size_t i = 0; i < attributes_.size(); ++i)
    attributes_[i] = static_cast<std::uint8_t>(number(at::FirstAttribute + i));
  boosting_ = false;
  return true;
}

} // namespace orb::vm
