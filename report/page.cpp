#include "report/page.h"

#include "base/text/utf8.h"
#include "report/assets.h"
#include "spec/basic.h"
#include "spec/macro.h"
#include "vm/matrix.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <functional>
#include <iterator>
#include <nlohmann/json.hpp>
#include <utility>

namespace orb::report {
namespace {

using nlohmann::ordered_json;

constexpr std::string_view schema = "orb.report/1";
constexpr std::string_view room_schema = "orb.room/1";

/// Interval of poses while the ball moves (docs/using/ball.md). A longer gap means that it stood
/// still.
constexpr Duration pose_period = std::chrono::milliseconds{50};

std::int64_t microseconds(Duration t) {
  return std::chrono::duration_cast<std::chrono::microseconds>(t).count();
}

/// Encodes integers as differences: short, and exact when summed.
template <class Entries, class Value>
ordered_json column(const Entries& entries, Value value) {
  auto list = ordered_json::array();
  std::int64_t before = 0;
  for (const auto& entry : entries) {
    const std::int64_t now = value(entry);
    list.push_back(now - before);
    before = now;
  }
  return list;
}

template <class Entries>
ordered_json times(const Entries& entries) {
  return column(entries, [](const auto& entry) { return microseconds(entry.t); });
}

template <class Entries, class Value>
ordered_json plain(const Entries& entries, Value value) {
  auto list = ordered_json::array();
  for (const auto& entry : entries)
    list.push_back(value(entry));
  return list;
}

std::int64_t scaled(double value, double scale) {
  return std::llround(value * scale);
}

ordered_json poses(const Journey& journey) {
  const auto& entries = journey.poses().entries();
  const auto by = [&](auto member, double scale) {
    return column(entries, [&](const auto& entry) { return scaled(entry.value.*member, scale); });
  };
  return {{"step", microseconds(std::max(pose_period, journey.poses().quantum() + pose_period))},
          {"t", times(entries)},
          {"x", by(&vm::Pose::x_cm, 1000)},
          {"y", by(&vm::Pose::y_cm, 1000)},
          {"heading", by(&vm::Pose::heading_deg, 10)},
          {"speed", by(&vm::Pose::speed_cm_s, 100)}};
}

int rgb(const vm::Color& color) {
  return color.red << 16 | color.green << 8 | color.blue;
}

ordered_json lamps(const Journey& journey) {
  const auto& entries = journey.led().entries();
  return {{"t", times(entries)},
          {"rgb", plain(entries, [](const auto& entry) { return rgb(entry.value); })}};
}

ordered_json pictures(const Journey& journey) {
  const auto& entries = journey.pictures().entries();
  return {{"t", times(entries)},
          {"pixels", plain(entries, [](const auto& entry) { return vm::hex_of(entry.value); })}};
}

ordered_json places(const Journey& journey) {
  const auto& entries = journey.places().entries();
  // Record only changes of the line; a loop on one line is one entry.
  std::vector<Series<Place>::Entry> changes;
  for (const auto& entry : entries)
    if (changes.empty() || changes.back().value != entry.value)
      changes.push_back(entry);
  return {{"t", times(changes)},
          {"file", plain(changes, [](const auto& entry) { return entry.value.file; })},
          {"line", plain(changes, [](const auto& entry) { return entry.value.line; })}};
}

/// Includes only variables that changed.
ordered_json variables(const Journey& journey) {
  auto list = ordered_json::array();
  for (const auto& variable : journey.variables()) {
    const auto& entries = variable.values.entries();
    if (entries.empty())
      continue;
    ordered_json one = {
        {"name", variable.name},
        {"t", times(entries)},
        {"v", column(entries, [](const auto& entry) { return std::int64_t{entry.value}; })}};
    if (!variable.owner.empty())
      one["of"] = variable.owner;
    if (variable.values.quantum() > Duration{})
      one["cut"] = true;
    list.push_back(std::move(one));
  }
  return list;
}

ordered_json files(const Journey& journey) {
  auto list = ordered_json::array();
  for (const auto& file : journey.files()) {
    auto counts = ordered_json::array();
    const auto index = static_cast<int>(list.size());
    for (const auto& [place, count] : journey.counts())
      if (place.file == index)
        counts.push_back({place.line, count.times, microseconds(count.first)});
    list.push_back({{"name", to_valid_utf8(file.name)},
                    {"text", to_valid_utf8(file.text)},
                    {"counts", counts},
                    {"failed", file.failed}});
  }
  return list;
}

ordered_json happening_json(const Happening& happening) {
  const bool prints = happening.kind == Happening::Kind::Print;
  ordered_json one = {{"t", microseconds(happening.t)},
                      {"kind", to_string(happening.kind)},
                      {"text", prints ? from_latin1(happening.text) : happening.text}};
  if (!happening.label.empty())
    one["short"] = happening.label;
  if (happening.at && happening.kind != Happening::Kind::Print) {
    one["x"] = happening.at->x_cm;
    one["y"] = happening.at->y_cm;
  }
  return one;
}

ordered_json happenings(const Journey::Listed& listed) {
  auto list = ordered_json::array();
  for (const auto& happening : listed.happenings) {
    auto one = happening_json(happening);
    if (listed.left_out > 0 && list.size() == listed.gap_at)
      one["gap"] = listed.left_out;
    list.push_back(std::move(one));
  }
  return list;
}

struct Channel {
  std::string_view name;
  std::size_t index; ///< into Sensors::values
};

struct Group {
  std::string_view id;
  std::string_view name;
  std::string_view unit;
  int scale;
  int digits;
  std::array<Channel, 3> channels;
  std::size_t channel_count;
};

constexpr auto groups = std::to_array<Group>({
    {"tilt", "Tilt", "°", 1, 0, {{{"pitch", 0}, {"roll", 1}}}, 2},
    {"acceleration", "Acceleration", "g", 1000, 3, {{{"x", 2}, {"y", 3}, {"z", 4}}}, 3},
    {"accelone", "accelone", "", 1, 0, {{{"accelone", 5}}}, 1},
    {"rotation", "Rotation", "°/s", 10, 1, {{{"x", 6}, {"y", 7}, {"z", 8}}}, 3},
    {"battery", "Battery", "V", 100, 2, {{{"Vbatt", 9}}}, 1},
});

ordered_json sensors(const Journey& journey) {
  auto list = ordered_json::array();
  const auto& entries = journey.sensors().entries();
  for (const auto& group : groups) {
    auto series = ordered_json::array();
    for (std::size_t i = 0; i < group.channel_count; ++i)
      series.push_back({{"name", group.channels[i].name},
                        {"scale", group.scale},
                        {"digits", group.digits},
                        {"v", column(entries, [&](const auto& entry) {
                           return static_cast<std::int64_t>(
                               entry.value.values[group.channels[i].index]);
                         })}});
    list.push_back({{"id", group.id},
                    {"name", group.name},
                    {"unit", group.unit},
                    {"t", times(entries)},
                    {"series", series}});
  }
  return list;
}

/// The words of the robot's languages, by syntax-colouring class.
ordered_json words(std::span<const std::string_view> keywords) {
  auto statements = plain(spec::statements, [](const auto& row) { return row.word; });
  for (const auto word : spec::particles)
    statements.push_back(word);
  const auto word_of = [](const auto& row) { return row.word; };
  return {
      {"basic",
       {{"statement", statements},
        {"function", plain(spec::functions, word_of)},
        {"sensor", plain(spec::variables, word_of)}}},
      {"structured", {{"statement", plain(keywords, [](auto word) { return word; })}}},
      {"macro",
       {{"statement", plain(spec::macro_commands, [](const auto& row) { return row.mnemonic; })}}}};
}

std::string thousands(std::uint64_t value) {
  auto digits = std::to_string(value);
  for (auto at = static_cast<std::ptrdiff_t>(digits.size()) - 3; at > 0; at -= 3)
    digits.insert(static_cast<std::size_t>(at), 1, ',');
  return digits;
}

/// Whole elapsed milliseconds, as in the last line of `orb run`.
std::string seconds(Duration t) {
  const auto ms = std::chrono::duration_cast<std::chrono::milliseconds>(t).count();
  return fmt::format("{}.{:03} s", ms / 1000, ms % 1000);
}

std::string distance(double cm) {
  return cm < 100 ? fmt::format("{:.1f} cm", cm) : fmt::format("{:.2f} m", cm / 100);
}

ordered_json totals(const Journey& journey) {
  const auto& totals = journey.totals();
  return ordered_json::array({
      {"robot time", seconds(journey.end().t), "time"},
      {"distance", distance(totals.distance_cm), "distance"},
      {"top speed", fmt::format("{:.1f} cm/s", totals.top_speed_cm_s), "top-speed"},
      totals.lines == 0 && totals.commands > 0
          ? ordered_json{"commands run", thousands(totals.commands), "commands"}
          : ordered_json{"lines run", thousands(totals.lines), "lines"},
  });
}

ordered_json counts(const Journey& journey) {
  ordered_json counts;
  for (std::size_t i = 0; i < Happening::kind_count; ++i)
    counts[std::string(to_string(static_cast<Happening::Kind>(i)))] =
        journey.totals().happenings[i];
  return counts;
}

ordered_json place(vm::Point point) {
  constexpr double digits = 1000; // thousandths of a centimetre
  return ordered_json::array(
      {std::round(point.x * digits) / digits, std::round(point.y * digits) / digits});
}

ordered_json walls(const Journey& journey) {
  auto list = ordered_json::array();
  for (const auto& wall : journey.walls()) {
    if (wall.axis == vm::Wall::Axis::None)
      list.push_back({{"from", place(wall.from)}, {"to", place(wall.to)}});
    else
      list.push_back({{"axis", wall.axis == vm::Wall::Axis::X ? "x" : "y"}, {"at", wall.at_cm}});
  }
  return list;
}

/// The zones, each with its rings. Walls are listed with those of the run.
ordered_json course(const Course& course) {
  auto zones = ordered_json::array();
  for (const auto& zone : course.zones) {
    auto rings = ordered_json::array();
    for (const auto& ring : zone.rings) {
      auto points = ordered_json::array();
      for (const auto& point : ring)
        points.push_back(place(point));
      rings.push_back(std::move(points));
    }
    zones.push_back({{"id", to_valid_utf8(zone.id)},
                     {"evenodd", zone.fill == Zone::Fill::EvenOdd},
                     {"rings", std::move(rings)}});
  }
  const auto box = course.box();
  return {{"name", to_valid_utf8(course.name)},
          {"ahead", {course.ahead.x, course.ahead.y}},
          {"low", place(box.low)},
          {"high", place(box.high)},
          {"zones", std::move(zones)}};
}

std::string thinned_words(const Journey& journey, const Journey::Listed& listed) {
  if (!journey.thinned() && listed.left_out == 0)
    return "";
  return "A run this long is drawn in coarser steps, and the list shows its first and last "
         "events. Totals and line counts are exact; `orb run --trace json` has every value.";
}

std::string outcome(const Journey::End& end) {
  return end.fault.empty() ? end.words : fmt::format("{}; {}", end.fault, end.words);
}

ordered_json run_data(const Journey& journey, std::string_view title,
                      std::span<const std::string_view> keywords) {
  const auto listed = journey.listed();
  ordered_json data = {{"schema", schema},
                       {"title", to_valid_utf8(title)},
                       {"end",
                        {{"t", microseconds(journey.end().t)},
                         {"reason", journey.end().reason},
                         {"text", outcome(journey.end())}}},
                       {"totals", totals(journey)},
                       {"counts", counts(journey)},
                       {"thinned", thinned_words(journey, listed)},
                       {"files", files(journey)},
                       {"words", words(keywords)},
                       {"walls", walls(journey)},
                       {"pose", poses(journey)},
                       {"led", lamps(journey)},
                       {"backled",
                        {{"t", times(journey.back_led().entries())},
                         {"value", plain(journey.back_led().entries(),
                                         [](const auto& entry) { return entry.value; })}}},
                       {"line", places(journey)},
                       {"variables", variables(journey)},
                       {"sensors", sensors(journey)},
                       {"events", happenings(listed)}};
  if (vm::has_matrix(journey.robot()))
    data["matrix"] = pictures(journey);
  if (journey.course())
    data["course"] = course(*journey.course());
  return data;
}

/// Returns the entries of `series` later than `t`.
template <class Value>
std::span<const typename Series<Value>::Entry> since(const Series<Value>& series, Duration t) {
  const auto& entries = series.entries();
  const auto first = std::partition_point(entries.begin(), entries.end(),
                                          [&](const auto& entry) { return entry.t <= t; });
  return std::span(entries).subspan(static_cast<std::size_t>(first - entries.begin()));
}

template <class Entries>
ordered_json plain_times(const Entries& entries) {
  return plain(entries, [](const auto& entry) { return microseconds(entry.t); });
}

ordered_json new_poses(std::span<const Series<vm::Pose>::Entry> entries) {
  const auto by = [&](auto member, double scale) {
    return plain(entries, [&](const auto& entry) {
      return std::round(entry.value.*member * scale) / scale;
    });
  };
  return {{"t", plain_times(entries)},
          {"x", by(&vm::Pose::x_cm, 1000)},
          {"y", by(&vm::Pose::y_cm, 1000)},
          {"heading", by(&vm::Pose::heading_deg, 10)},
          {"speed", by(&vm::Pose::speed_cm_s, 100)}};
}

/// Only the last line that ran is visible.
ordered_json new_places(std::span<const Series<Place>::Entry> entries) {
  if (!entries.empty())
    entries = entries.last(1);
  return {{"t", plain_times(entries)},
          {"file", plain(entries, [](const auto& entry) { return entry.value.file; })},
          {"line", plain(entries, [](const auto& entry) { return entry.value.line; })}};
}

ordered_json new_happenings(const Journey& journey, std::uint64_t& told) {
  auto list = ordered_json::array();
  std::uint64_t all = 0;
  for (const auto count : journey.totals().happenings)
    all += count;
  if (all == told)
    return list;
  const auto listed = journey.listed().happenings;
  const auto fresh = std::min<std::uint64_t>(all - std::exchange(told, all), listed.size());
  for (const auto& happening : std::span(listed).last(fresh))
    list.push_back(happening_json(happening));
  return list;
}

/// Escapes JSON for a script element: without `<` it cannot contain an end tag or comment.
std::string script_safe(const ordered_json& data) {
  const auto text = data.dump(-1, ' ', true, ordered_json::error_handler_t::replace);
  std::string safe;
  safe.reserve(text.size());
  for (const char c : text) {
    if (c == '<')
      safe += "\\u003c";
    else
      safe += c;
  }
  return safe;
}

} // namespace

std::string run_json(const Journey& journey, std::string_view title,
                     std::span<const std::string_view> keywords) {
  return script_safe(run_data(journey, title, keywords));
}

std::string growth_json(const Journey& journey, Shown& shown) {
  const auto until = shown.until;
  const auto tell = [&](const auto& entries) {
    if (!entries.empty())
      shown.until = std::max(shown.until, entries.back().t);
    return entries;
  };
  const auto led = tell(since(journey.led(), until));
  const auto back_led = tell(since(journey.back_led(), until));
  ordered_json data = {
      {"pose", new_poses(tell(since(journey.poses(), until)))},
      {"led",
       {{"t", plain_times(led)},
        {"rgb", plain(led, [](const auto& entry) { return rgb(entry.value); })}}},
      {"backled",
       {{"t", plain_times(back_led)},
        {"value", plain(back_led, [](const auto& entry) { return entry.value; })}}},
      {"line", new_places(tell(since(journey.places(), until)))},
      {"events", new_happenings(journey, shown.happenings)},
      {"totals", totals(journey)}};
  if (const auto fresh = tell(since(journey.pictures(), until)); !fresh.empty())
    data["matrix"] = {{"t", plain_times(fresh)}, {"pixels", plain(fresh, [](const auto& entry) {
                                                    return vm::hex_of(entry.value);
                                                  })}};
  return script_safe(data);
}

std::optional<std::string> run_of_page(std::string_view page) {
  constexpr std::string_view head = "<script type=\"application/json\" id=\"run\">";
  const auto begin = page.find(head);
  if (begin == std::string_view::npos)
    return std::nullopt;
  const auto rest = page.substr(begin + head.size());
  const auto run = ordered_json::parse(rest.substr(0, rest.find("</script>")), nullptr, false);
  if (!run.is_object() || run.value("schema", "") != schema)
    return std::nullopt;
  return script_safe(run);
}

namespace {

std::string page_of(std::string_view run, std::string_view before) {
  std::string_view rest = page_html;
  std::string page;
  const auto fill = [&](std::string_view place, std::string_view with) {
    const auto at = rest.find(place);
    page += rest.substr(0, at);
    page += with;
    rest.remove_prefix(at + place.size());
  };
  fill("/*{style}*/", page_css);
  fill("/*{run}*/", run);
  fill("/*{before}*/", before.empty() ? "null" : before);
  fill("/*{script}*/", page_js);
  return page += rest;
}

} // namespace

std::string report_page(const Journey& journey, std::string_view title, std::string_view before,
                        std::span<const std::string_view> keywords) {
  return page_of(run_json(journey, title, keywords), before);
}

std::string room_page(std::span<const RoomRun> balls, std::string_view title,
                      std::span<const std::string_view> keywords) {
  auto list = ordered_json::array();
  for (const auto& ball : balls)
    list.push_back(
        {{"name", to_valid_utf8(ball.name)},
         {"run", run_data(*ball.journey, fmt::format("{}: {}", title, ball.name), keywords)}});
  const ordered_json room = {
      {"schema", room_schema}, {"title", to_valid_utf8(title)}, {"balls", std::move(list)}};
  return page_of(script_safe(room), {});
}

} // namespace orb::report
