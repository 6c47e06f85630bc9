#include "protocol/ble_faults.h"

#include "base/text/suggest.h"
#include "base/text/text.h"
#include "protocol/plan_words.h"

#include <array>
#include <fmt/format.h>
#include <vector>

namespace orb::protocol {
namespace {

struct Flag {
  std::string_view word;
  bool BleFaultPlan::*member;
};

constexpr auto flags = std::to_array<Flag>({{"no-daemon", &BleFaultPlan::no_daemon},
                                            {"no-adapter", &BleFaultPlan::no_adapter},
                                            {"adapter-off", &BleFaultPlan::adapter_off},
                                            {"denied", &BleFaultPlan::denied},
                                            {"away", &BleFaultPlan::away},
                                            {"held", &BleFaultPlan::held},
                                            {"newer", &BleFaultPlan::newer},
                                            {"undriven", &BleFaultPlan::undriven},
                                            {"mute", &BleFaultPlan::mute}});

struct StepWord {
  std::string_view word;
  std::optional<BleStep> BleFaultPlan::*member;
};

constexpr auto places = std::to_array<StepWord>({{"drop@", &BleFaultPlan::drop},
                                                 {"drop-once@", &BleFaultPlan::drop_once},
                                                 {"refuse@", &BleFaultPlan::balk},
                                                 {"refuse-once@", &BleFaultPlan::balk_once},
                                                 {"vanish@", &BleFaultPlan::vanish}});

constexpr auto others = std::to_array<std::string_view>(
    {"pieces=", "links=", "late=", "interval=", "lose=", "refuse=", "seed="});

std::vector<std::string_view> all_words() {
  std::vector<std::string_view> words(others.begin(), others.end());
  for (const auto& place : places)
    words.push_back(place.word);
  for (const auto& flag : flags)
    words.push_back(flag.word);
  return words;
}

tl::expected<void, std::string> read_step(std::string_view item, std::string_view value,
                                          std::optional<BleStep>& step) {
  std::vector<std::string_view> words;
  for (const auto& row : ble_steps) {
    // There is no link to drop before.
    if (row.step < BleStep::Connect)
      continue;
    words.push_back(row.word);
    if (row.word == value)
      step = row.step;
  }
  if (!step)
    return wrong_word(item, fmt::format("the steps are {}", fmt::join(words, ", ")));
  return {};
}

bool read_pieces(std::string_view value, BleFaultPlan& plan) {
  const auto [first, last] = split_range(value);
  const auto least = parse_number<std::size_t>(first);
  const auto most = parse_number<std::size_t>(last);
  if (!least || !most || *least == 0 || *most < *least || *most > spec::ble_piece_bytes)
    return false;
  plan.pieces_least = *least;
  plan.pieces_most = *most;
  return true;
}

tl::expected<void, std::string> read_value(std::string_view item, std::string_view name,
                                           std::string_view value, BleFaultPlan& plan) {
  if (name == "pieces=") {
    if (!read_pieces(value, plan))
      return wrong_word(item, fmt::format("pieces have 1 to {0} bytes, as in `pieces=1..{0}`",
                                          spec::ble_piece_bytes));
    return {};
  }
  if (name == "links=") {
    const auto links = parse_number<std::size_t>(value);
    if (!links || *links == 0)
      return wrong_word(item, "an adapter holds a number of links, as in `links=7`");
    plan.links = *links;
    return {};
  }
  if (name == "late=" || name == "interval=") {
    const auto time = read_delay(value);
    if (!time)
      return wrong_word(item, "a time is written `2s` or `300ms`, at most one hour");
    (name == "late=" ? plan.late : plan.interval) = *time;
    return {};
  }
  if (name == "lose=" || name == "refuse=") {
    const auto rate = read_rate(value);
    if (!rate)
      return wrong_word(item, "a rate is written in percent, such as `1%` or `0.1%`");
    (name == "lose=" ? plan.lose : plan.refuse) = *rate;
    return {};
  }
  if (name == "seed=") {
    const auto seed = parse_number<std::uint64_t>(value);
    if (!seed)
      return wrong_word(item, "a seed is a whole number");
    plan.seed = *seed;
    return {};
  }
  const auto words = all_words();
  return wrong_word(
      item,
      fmt::format("unknown; {}",
                  did_you_mean(name, words, fmt::format("use one of {}", fmt::join(words, " ")))));
}

tl::expected<void, std::string> read_ble_item(std::string_view item, BleFaultPlan& plan) {
  for (const auto& flag : flags)
    if (item == flag.word) {
      plan.*flag.member = true;
      return {};
    }
  const auto [name, value] = split_item(item);
  for (const auto& place : places)
    if (name == place.word)
      return read_step(item, value, plan.*place.member);
  return read_value(item, name, value, plan);
}

} // namespace

tl::expected<BleFaultPlan, std::string> parse_ble_fault_plan(std::string_view text) {
  BleFaultPlan plan;
  const auto read =
      read_words(text, [&](std::string_view item) { return read_ble_item(item, plan); });
  if (!read)
    return tl::unexpected(read.error());
  return plan;
}

} // namespace orb::protocol
