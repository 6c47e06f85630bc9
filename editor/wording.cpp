#include "editor/wording.h"

#include <algorithm>
#include <utility>

namespace orb::editor {
namespace {

/// Reads a count; numbers that are too large become the largest one.
std::optional<std::uint32_t> count_of(const Json& json) {
  if (!json.is_number_integer())
    return std::nullopt;
  if (!json.is_number_unsigned() && json.get<std::int64_t>() < 0)
    return std::nullopt;
  return static_cast<std::uint32_t>(std::min<std::uint64_t>(json.get<std::uint64_t>(), 0x7FFFFFFF));
}

Json in_json(TextPosition place) {
  return {{"line", place.line}, {"character", place.character}};
}

} // namespace

const Json& member(const Json& json, const char* name) {
  static const Json null;
  if (!json.is_object())
    return null;
  const auto found = json.find(name);
  return found == json.end() ? null : *found;
}

std::string text_of(const Json& json) {
  return json.is_string() ? json.get<std::string>() : std::string();
}

Json Wording::position(const Source& source, std::uint32_t offset) const {
  return in_json(ruler(source)(offset));
}

Json Wording::range(Ruler& ruler, Span span) {
  auto begin = in_json(ruler(span.begin)); // the outer one of the two
  return {{"start", std::move(begin)}, {"end", in_json(ruler(span.end))}};
}

Json Wording::edit(const Source& source, const Edit& one) const {
  return {{"range", range(source, one.span)}, {"newText", one.text}};
}

Json Wording::edits(const Source& source, const std::vector<Edit>& many) const {
  auto list = Json::array();
  auto places = ruler(source);
  for (const auto& one : many)
    list.push_back({{"range", range(places, one.span)}, {"newText", one.text}});
  return list;
}

Json Wording::replace_all(const Source& source, const std::string& text) const {
  if (text == source.text())
    return Json::array();
  return edits(source, {{{0, static_cast<std::uint32_t>(source.text().size())}, text}});
}

std::optional<std::uint32_t> Wording::offset(const Source& source, const Json& json) const {
  const auto line = count_of(member(json, "line"));
  const auto character = count_of(member(json, "character"));
  if (!line || !character)
    return std::nullopt;
  return offset_of(source, {*line, *character}, encoding);
}

std::optional<Span> Wording::span(const Source& source, const Json& json) const {
  const auto begin = offset(source, member(json, "start"));
  const auto end = offset(source, member(json, "end"));
  if (!begin || !end)
    return std::nullopt;
  return Span{std::min(*begin, *end), std::max(*begin, *end)};
}

} // namespace orb::editor
