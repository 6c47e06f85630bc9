#include "cli/room/room_plan.h"

#include "base/refuse.h"
#include "base/text/suggest.h"
#include "base/text/text.h"
#include "cli/context/config.h"
#include "cli/input/inputs.h"
#include "cli/model/checks.h"
#include "disk/disk.h"
#include "spec/robots.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <map>

// Makes invalid TOML a result, not an exception.
#define TOML_EXCEPTIONS 0
#include <toml++/toml.h>

namespace orb::cli {
namespace {

namespace fs = std::filesystem;

constexpr double spacing_cm = 30; ///< between balls without a given place
constexpr double farthest_cm = 1e6;

std::string region_in(const std::string& file, const toml::source_region& region) {
  return fmt::format("{}:{}:{}", file, region.begin.line, region.begin.column);
}

/// Reads a table and remembers its first error.
class Reading {
public:
  explicit Reading(const std::string& file) : file_(file) {}

  const std::string& problem() const { return problem_; }
  void refuse(const toml::node& node, std::string_view what) { refuse_at(node.source(), what); }
  void refuse_at(const toml::source_region& region, std::string_view what) {
    if (problem_.empty())
      problem_ = fmt::format("{}: {}", region_in(file_, region), what);
  }

  std::string text(std::string_view key, const toml::node& node) {
    if (const auto* text = node.as_string(); text != nullptr && !text->get().empty())
      return text->get();
    refuse(node, fmt::format("`{}` takes a string in quotes", key));
    return {};
  }
  /// Reads a text or a list of texts.
  std::vector<std::string> texts(std::string_view key, const toml::node& node) {
    const auto* list = node.as_array();
    if (list == nullptr)
      return {text(key, node)};
    std::vector<std::string> all;
    for (const auto& one : *list)
      all.push_back(text(key, one));
    if (all.empty())
      refuse(node, fmt::format("`{}` takes a string in quotes, or a list of them", key));
    return all;
  }
  /// Reads a number of centimetres or degrees.
  double number(std::string_view key, const toml::node& node) {
    const auto value = node.value<double>();
    if (value && !node.is_boolean() && std::abs(*value) <= farthest_cm)
      return *value;
    refuse(node, fmt::format("`{}` takes numbers", key));
    return 0;
  }
  vm::Point point(std::string_view key, const toml::node& node) {
    const auto* list = node.as_array();
    if (list != nullptr && list->size() == 2)
      return {number(key, (*list)[0]), number(key, (*list)[1])};
    refuse(node, fmt::format("`{}` takes two numbers, centimetres to the right and ahead: `{} = "
                             "[30, 0]`",
                             key, key));
    return {};
  }
  std::uint64_t seed(const toml::node& node) {
    if (const auto* value = node.as_integer(); value != nullptr && value->get() >= 0)
      return static_cast<std::uint64_t>(value->get());
    refuse(node, "`seed` takes a whole number, 0 or greater");
    return 0;
  }
  std::string robot(const toml::node& node) {
    const auto name = text("robot", node);
    if (problem_.empty() && !spec::find_robot(name))
      refuse(node, fmt::format("`{}` is not a robot{}", name,
                               meant_instead(name, names_of(spec::robots))));
    return name;
  }

private:
  const std::string& file_;
  std::string problem_;
};

constexpr std::array<std::string_view, 7> ball_keys{"name", "program", "at",      "facing",
                                                    "seed", "robot",   "stimulus"};
constexpr std::array<std::string_view, 2> room_keys{"course", "ball"};

template <class Keys>
std::string unknown(std::string_view key, const Keys& keys, std::string_view of) {
  const std::span<const std::string_view> words(keys);
  return fmt::format(
      "`{}` is not a key of {}; {}", key, of,
      did_you_mean(key, words, fmt::format("the keys are {}", fmt::join(keys, ", "))));
}

/// Resolves a path relative to the room's file.
std::string beside(const std::string& file, const std::string& path) {
  return disk::as_path(path).is_absolute()
             ? path
             : (disk::as_path(file).parent_path() / disk::as_path(path)).generic_string();
}

std::string stem(const std::string& path) {
  return disk::as_path(path).stem().string();
}

PlannedBall read_ball(Reading& reading, const std::string& file, const toml::table& table) {
  PlannedBall ball;
  ball.place = region_in(file, table.source());
  for (const auto& [key, node] : table) {
    if (key == "name")
      ball.name = reading.text(key.str(), node);
    else if (key == "program")
      for (const auto& path : reading.texts(key.str(), node))
        ball.files.push_back(beside(file, path));
    else if (key == "at")
      ball.start.place = reading.point(key.str(), node);
    else if (key == "facing")
      ball.start.facing_deg = reading.number(key.str(), node);
    else if (key == "seed")
      ball.seed = reading.seed(node);
    else if (key == "robot")
      ball.robot = reading.robot(node);
    else if (key == "stimulus")
      for (const auto& one : reading.texts(key.str(), node))
        ball.stimuli.push_back(is_stimulus_line(one) ? one : beside(file, one));
    else
      reading.refuse_at(key.source(), unknown(key.str(), ball_keys, "a ball"));
  }
  if (ball.files.empty())
    reading.refuse(table, "a ball needs a program: `program = \"red.orb\"`");
  else if (ball.name.empty())
    ball.name = stem(ball.files.front());
  return ball;
}

/// Reports two balls with the same name; empty if names are unique.
std::string same_name(const std::vector<PlannedBall>& balls) {
  std::map<std::string_view, const PlannedBall*> known;
  for (const auto& ball : balls)
    if (const auto [at, fresh] = known.emplace(ball.name, &ball); !fresh)
      return ball.place.empty()
                 ? fmt::format(
                       "{} and {} would both be named `{}`; give them names in a room file; "
                       "see docs/using/rooms.md",
                       at->second->files.front(), ball.files.front(), ball.name)
                 : fmt::format(
                       "{}: the ball at {} is also called `{}`; give one of them another `name`",
                       ball.place, at->second->place, ball.name);
  return {};
}

} // namespace

bool is_room_file(std::string_view name) {
  return has_ending(name, ".toml");
}

tl::expected<RoomPlan, Failure> read_room(const std::string& path) {
  const auto text = read_text(path);
  if (!text)
    return tl::unexpected(text.error());
  const auto file = disk::display_name(path);
  const auto parsed = toml::parse(*text, file);
  if (!parsed)
    return refuse(ExitCode::Usage,
                  fmt::format("{}: not TOML: {}", region_in(file, parsed.error().source()),
                              toml_words(parsed.error().description())));
  RoomPlan plan;
  Reading reading(file);
  for (const auto& [key, node] : parsed.table()) {
    if (key == "course")
      plan.course = beside(path, reading.text(key.str(), node));
    else if (const auto* list = node.as_array();
             key == "ball" && list && list->is_array_of_tables())
      for (const auto& one : *list)
        plan.balls.push_back(read_ball(reading, path, *one.as_table()));
    else if (key == "ball")
      reading.refuse(node, "each ball begins with `[[ball]]`");
    else
      reading.refuse_at(key.source(), unknown(key.str(), room_keys, "a room"));
  }
  if (!reading.problem().empty())
    return refuse(ExitCode::Usage, reading.problem());
  if (plan.balls.empty())
    return refuse(ExitCode::Usage, fmt::format("{}: the room is empty; each ball begins with "
                                               "`[[ball]]`",
                                               file));
  if (auto twice = same_name(plan.balls); !twice.empty())
    return refuse(ExitCode::Usage, std::move(twice));
  return plan;
}

tl::expected<RoomPlan, Failure> side_by_side(const std::vector<std::string>& files) {
  RoomPlan plan;
  for (const auto& file : files)
    plan.balls.push_back({stem(file), {file}, {}, {}, {}, {}, {}});
  if (auto twice = same_name(plan.balls); !twice.empty())
    return refuse(ExitCode::Usage, std::move(twice));
  std::vector<PlannedBall*> order;
  for (auto& ball : plan.balls)
    order.push_back(&ball);
  std::sort(order.begin(), order.end(),
            [](const auto* a, const auto* b) { return a->name < b->name; });
  for (std::size_t i = 0; i < order.size(); ++i)
    order[i]->start.place.x = spacing_cm * static_cast<double>(i);
  return plan;
}

} // namespace orb::cli
