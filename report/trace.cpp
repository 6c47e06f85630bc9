#include "report/trace.h"

#include "vm/matrix.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <iterator>

namespace orb::report {

namespace {

/// The columns after `t` and `event`: all keys, in the order in which events use them.
constexpr auto columns = std::to_array<std::string_view>({
    "r",      "g",      "b",         "heading", "speed",    "go",      "x",      "y",
    "marker", "macro",  "command",   "line",    "code",     "message", "reason", "lines",
    "text",   "value",  "axis",      "xmag",    "ymag",     "seconds", "id",     "wall",
    "at",     "detail", "parameter", "least",   "greatest",
});

template <class... Functions>
struct Overloaded : Functions... {
  using Functions::operator()...;
};
template <class... Functions>
Overloaded(Functions...) -> Overloaded<Functions...>;

/// Quotes the robot's text as JSON: bytes above 7Fh are U+0080 to U+00FF.
std::string json_string(std::string_view text) {
  std::string out = "\"";
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\')
      (out += '\\') += c;
    else if (c == '\n')
      out += "\\n";
    else if (byte < 0x20 || byte >= 0x7F)
      fmt::format_to(std::back_inserter(out), "\\u{:04x}", byte);
    else
      out += c;
  }
  return out + '"';
}

/// Quotes the text as a CSV field; each byte of it becomes a code point in UTF-8.
std::string csv_string(std::string_view text) {
  std::string out = "\"";
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '"')
      out += "\"\"";
    else if (byte >= 0x80) {
      out += static_cast<char>(0xC0 | byte >> 6);
      out += static_cast<char>(0x80 | (byte & 0x3F));
    } else
      out += c;
  }
  return out + '"';
}

std::string two_decimals(double value) {
  // A tenth of a millimetre. No sign before zero.
  auto text = fmt::format("{:.2f}", value);
  return text == "-0.00" ? "0.00" : text;
}

std::string milliseconds(Duration t) {
  const auto microseconds = t / std::chrono::microseconds{1};
  return fmt::format("{}.{:03}", microseconds / 1000, microseconds % 1000);
}

std::string printed(TraceFormat format, const TraceField& field) {
  return std::visit(Overloaded{
                        [](std::int64_t value) { return fmt::format("{}", value); },
                        [](double value) { return two_decimals(value); },
                        [&](const std::string& value) {
                          return format == TraceFormat::Json ? json_string(value)
                                                             : csv_string(value);
                        },
                    },
                    field.value);
}

} // namespace

std::string trace_head(TraceFormat format) {
  if (format == TraceFormat::Json)
    return {};
  std::string head = "t,event";
  for (const auto column : columns)
    (head += ',') += column;
  return head + '\n';
}

std::string room_trace_head(TraceFormat format, bool sources) {
  auto head = trace_head(format);
  if (!head.empty())
    head.insert(head.size() - 1, sources ? ",source,ball,with" : ",ball,with");
  return head;
}

std::string trace_line(TraceFormat format, Duration t, std::string_view event,
                       const std::vector<TraceField>& fields) {
  std::string out;
  if (format == TraceFormat::Json) {
    out = fmt::format("{{\"t\":{},\"event\":\"{}\"", milliseconds(t), event);
    for (const auto& field : fields)
      fmt::format_to(std::back_inserter(out), ",\"{}\":{}", field.key, printed(format, field));
    return out + "}\n";
  }
  out = fmt::format("{},{}", milliseconds(t), event);
  for (const auto column : columns) {
    out += ',';
    const auto field = std::find_if(fields.begin(), fields.end(),
                                    [&](const auto& candidate) { return candidate.key == column; });
    if (field != fields.end())
      out += printed(format, *field);
  }
  return out + '\n';
}

std::string trace_line(TraceFormat format, Duration t, const vm::Event& event) {
  namespace e = vm::event;
  using Fields = std::vector<TraceField>;
  const auto n = [](int value) { return std::int64_t{value}; };
  const auto line = [&](std::string_view name, const Fields& fields) {
    return trace_line(format, t, name, fields);
  };
  return std::visit(
      Overloaded{
          [&](const e::Print& x) {
            return line("print", {{"text", x.text}});
          },
          [&](const e::Error& x) {
            return line("error", {{"line", n(x.line)},
                                  {"code", n(spec::code(x.code))},
                                  {"message", std::string(spec::info(x.code).text)}});
          },
          [&](const e::Led& x) {
            return line("led",
                        {{"r", n(x.color.red)}, {"g", n(x.color.green)}, {"b", n(x.color.blue)}});
          },
          [&](const e::BackLed& x) {
            return line("backled", {{"value", n(x.value)}});
          },
          [&](const e::Matrix& x) {
            // A separate column would change every trace of robots without a matrix.
            const std::string_view key = format == TraceFormat::Csv ? "text" : "pixels";
            return line("matrix", {{key, vm::hex_of(x.pixels)}});
          },
          [&](const e::Drive& x) {
            return line("drive", {{"heading", n(x.roll.heading_deg)},
                                  {"speed", n(x.roll.speed)},
                                  {"go", n(static_cast<int>(x.roll.go))}});
          },
          [&](const e::Position& x) {
            Fields fields{{"x", x.pose.x_cm},
                          {"y", x.pose.y_cm},
                          {"heading", x.pose.heading_deg},
                          {"speed", x.pose.speed_cm_s}};
            if (x.age)
              fields.push_back(
                  {"age_ms", std::chrono::duration<double, std::milli>(*x.age).count()});
            return line("pose", fields);
          },
          [&](const e::Marker& x) {
            return line(
                "marker",
                {{"marker", n(x.marker)}, {"macro", n(x.macro)}, {"command", n(x.command)}});
          },
          [&](const e::Macro& x) {
            return line("macro", {{"id", n(x.id)}, {"command", n(x.command)}});
          },
          [&](const e::Line& x) {
            return line("line", {{"line", n(x.line)}});
          },
          [&](const e::Collision& x) {
            return line("collision", {{"x", n(x.x)},
                                      {"y", n(x.y)},
                                      {"axis", n(x.axis)},
                                      {"xmag", n(x.x_magnitude)},
                                      {"ymag", n(x.y_magnitude)},
                                      {"speed", n(x.speed)}});
          },
          [&](const e::Sleep& x) {
            return line("sleep",
                        {{"seconds", n(x.seconds)}, {"macro", n(x.macro)}, {"line", n(x.line)}});
          },
          [&](const e::End&) { return std::string(); },
          [&](const e::MacroEnd&) { return std::string(); },
          [&](const e::StopLost&) {
            return line("stop", {{"reason", std::string("not acknowledged")}});
          },
          [&](const e::Bump& x) {
            if (!x.ball.empty())
              return line("bump", {{"with", x.ball}, {"speed", n(x.speed)}});
            if (x.wall.axis == vm::Wall::Axis::None)
              return line("bump", {{"wall", vm::to_string(x.wall)}, {"speed", n(x.speed)}});
            return line("bump",
                        {{"wall", std::string(x.wall.axis == vm::Wall::Axis::X ? "x" : "y")},
                         {"at", x.wall.at_cm},
                         {"speed", n(x.speed)}});
          },
      },
      event);
}

namespace {

/// Returns the robot line of an event; 0 if it has none.
int line_of(const vm::Event& event) {
  if (const auto* error = std::get_if<vm::event::Error>(&event))
    return error->line;
  const auto* line = std::get_if<vm::event::Line>(&event);
  return line == nullptr ? 0 : line->line;
}

} // namespace

TraceWriter::TraceWriter(TraceFormat format, TraceLines lines,
                         std::function<void(std::string_view)> put, LinePlaces places, TraceOf of)
    : format_(format), lines_(lines), put_(std::move(put)), places_(std::move(places)),
      of_(std::move(of)) {
  if (of_.ball.empty())
    put_(with_source(trace_head(format_), "source"));
}

void TraceWriter::add(Duration t, const vm::Event& event) {
  if (lines_ == TraceLines::Leave && std::holds_alternative<vm::event::Line>(event))
    return;
  const auto place = places_.find(line_of(event));
  const bool known = place != places_.end();
  const auto* bump = std::get_if<vm::event::Bump>(&event);
  tell(trace_line(format_, t, event),
       known ? printed(format_, {"source", place->second}) : std::string(),
       bump == nullptr ? std::string() : bump->ball);
}

std::string TraceWriter::with_source(std::string line, const std::string& source) const {
  if (line.empty() || (places_.empty() && !of_.sources))
    return line;
  if (format_ == TraceFormat::Csv)
    line.insert(line.size() - 1, "," + source);
  else if (!source.empty())
    line.insert(line.size() - 2, ",\"source\":" + source);
  return line;
}

/// Writes a line, extended by its source place and, in a room, by its ball and the other ball.
void TraceWriter::tell(std::string line, const std::string& source, const std::string& other) {
  if (line.empty())
    return;
  line = with_source(std::move(line), source);
  if (!of_.ball.empty() && format_ == TraceFormat::Csv)
    line.insert(line.size() - 1, fmt::format(",{},{}", csv_string(of_.ball),
                                             other.empty() ? "" : csv_string(other)));
  else if (!of_.ball.empty())
    line.insert(line.find(','), ",\"ball\":" + json_string(of_.ball));
  put_(line);
}

void TraceWriter::add(Duration t, std::string_view event, const std::vector<TraceField>& fields) {
  const auto line = std::find_if(fields.begin(), fields.end(),
                                 [](const auto& field) { return field.key == "line"; });
  const auto place = line == fields.end()
                         ? places_.end()
                         : places_.find(static_cast<int>(std::get<std::int64_t>(line->value)));
  tell(trace_line(format_, t, event, fields),
       place == places_.end() ? std::string() : printed(format_, {"source", place->second}));
}

void TraceWriter::finish(Duration t, std::string_view reason, std::uint64_t lines) {
  const auto line =
      trace_line(format_, t, "end",
                 {{"reason", std::string(reason)}, {"lines", static_cast<std::int64_t>(lines)}});
  tell(line, {});
}

} // namespace orb::report
