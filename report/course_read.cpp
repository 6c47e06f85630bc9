#include "report/course_reader.h"

namespace orb::report {

namespace {

// Limits of a course. The explanation of course-too-large repeats them.
constexpr std::size_t most_bytes = 4 << 20;
constexpr int most_groups = 64;
constexpr std::size_t most_elements = 100'000;
constexpr std::size_t most_findings = 50;

struct RoleName {
  std::string_view word;
  Role role;
};
// People name layers in the plural.
constexpr auto role_names = std::to_array<RoleName>({
    {"wall", Role::Wall},
    {"walls", Role::Wall},
    {"zone", Role::Zone},
    {"zones", Role::Zone},
    {"start", Role::Start},
});

/// Elements whose children are not drawn in place.
constexpr auto hidden_elements =
    std::to_array<std::string_view>({"defs", "symbol", "clipPath", "mask", "pattern", "marker",
                                     "metadata", "style", "title", "desc"});

constexpr double cm_in_inch = 2.54;

struct Unit {
  std::string_view name;
  double cm;
};

constexpr auto units = std::to_array<Unit>({
    {"mm", 0.1},
    {"cm", 1},
    {"in", cm_in_inch},
    {"px", cm_in_inch / 96}, // Source: CSS: 96 to the inch
    {"pt", cm_in_inch / 72},
    {"pc", cm_in_inch / 6},
});

std::string_view local_name(std::string_view name) {
  return name.starts_with("svg:") ? name.substr(4) : name;
}

} // namespace

CourseReading CourseReader::read() {
  const auto& name = source_.name();
  const auto file = file_name(name);
  out_.course.name = is_course(file) ? stem(file) : file;
  if (is_text() && parse())
    read_drawing();
  sort_by_place(out_.findings);
  return std::move(out_);
}

void CourseReader::say(const Rule& rule, Span span, Message message, Message help) {
  if (out_.findings.size() < most_findings)
    out_.findings.push_back(finding(rule, span, std::move(message), std::move(help)));
}

Span CourseReader::place(const pugi::xml_node& node) const {
  const auto offset = node.offset_debug();
  if (offset < 1)
    return {};
  const auto begin = static_cast<std::uint32_t>(offset) - 1;
  const auto length = std::string_view(node.name()).size() + 1;
  return {begin, std::min(begin + static_cast<std::uint32_t>(length), size())};
}

Span CourseReader::place(const pugi::xml_node& node, std::string_view attribute) const {
  const auto element = place(node);
  std::size_t at = element.end;
  while (at < text_.size() && text_[at] != '>' && text_[at] != '/') {
    const auto begin = text_.find_first_not_of(" \t\r\n", at);
    const auto equals = text_.find('=', at);
    if (equals == std::string_view::npos)
      break;
    const auto quote = text_.find_first_of("\"'", equals);
    const auto end = quote == std::string_view::npos ? quote : text_.find(text_[quote], quote + 1);
    if (end == std::string_view::npos)
      break;
    auto name = text_.substr(begin, equals - begin);
    while (!name.empty() && (is_blank(name.back()) || name.back() == '\n' || name.back() == '\r'))
      name.remove_suffix(1);
    if (name == attribute)
      return {static_cast<std::uint32_t>(quote) + 1, static_cast<std::uint32_t>(end)};
    at = std::min(text_.find_first_not_of(" \t\r\n", end + 1), text_.size());
  }
  return element;
}

Span CourseReader::place(const pugi::xml_node& node, std::string_view attribute,
                         Span within) const {
  const auto value = place(node, attribute);
  return {std::min(value.begin + within.begin, value.end),
          std::min(value.begin + within.end, value.end)};
}

bool CourseReader::is_text() {
  if (text_.size() > most_bytes) {
    say(rules::CourseTooLarge, {0, 0}, texts::FileSize(text_.size()), texts::FileLimit());
    return false;
  }
  if (text_.starts_with("\x1f\x8b")) {
    say(rules::CourseXml, {0, 0}, texts::Compressed(), texts::NotCompressed());
    return false;
  }
  const auto odd = std::find_if(text_.begin(), text_.end(), [](char c) {
    return static_cast<unsigned char>(c) < ' ' && c != '\t' && c != '\n' && c != '\r';
  });
  if (odd != text_.end()) {
    const auto at = static_cast<std::uint32_t>(odd - text_.begin());
    say(rules::CourseXml, {at, at + 1}, texts::NotText(), texts::SvgIsPlain());
    return false;
  }
  if (const auto at = text_.find("<!ENTITY"); at != std::string_view::npos) {
    const auto begin = static_cast<std::uint32_t>(at);
    say(rules::CourseXml, {begin, begin + 8}, texts::HasEntities(), texts::PlainSvg());
    return false;
  }
  return true;
}

bool CourseReader::parse() {
  const auto result =
      document_.load_buffer(text_.data(), text_.size(), pugi::parse_default, pugi::encoding_utf8);
  if (!result) {
    const auto at =
        std::min(static_cast<std::uint32_t>(std::max<std::ptrdiff_t>(result.offset, 0)), size());
    const bool tags = result.status == pugi::status_end_element_mismatch;
    const bool none = result.status == pugi::status_no_document_element;
    std::string why = result.description();
    why.front() = to_lower(why.front());
    say(rules::CourseXml, {at, std::min(at + 1, size())},
        tags ? texts::StrayEndTag() : texts::NotXml(why),
        tags   ? texts::TagsPair()
        : none ? texts::SvgIsPlain()
               : Message());
    return false;
  }
  const auto root = document_.document_element();
  if (local_name(root.name()) != "svg") {
    say(rules::CourseXml, place(root), texts::NotSvg(root.name()), texts::ASvg());
    return false;
  }
  return true;
}

void CourseReader::read_drawing() {
  const auto root = document_.document_element();
  const double cm = scale(root);
  Matrix to_cm;
  to_cm.a = cm;
  to_cm.d = -cm;
  walk({root, "svg", to_cm, Role::None}, 0);
  if (failed() || !find_start())
    return;
  if (out_.course.walls.empty() && out_.course.zones.empty())
    say(rules::CourseEmpty, place(root), texts::NoElement(), texts::GiveClass());
}

double CourseReader::scale(const pugi::xml_node& root) {
  const auto box = attribute_numbers(root, "viewBox");
  if (box.empty())
    return 1;
  if (box.size() != 4 || box[2] <= 0 || box[3] <= 0) {
    say(rules::CourseValue, place(root, "viewBox"), texts::ViewBoxTakes(),
        texts::AsIn("viewBox=\"0 0 210 297\""));
    return 1;
  }
  const auto wide = size_cm(root, "width");
  const auto tall = size_cm(root, "height");
  if (!wide && !tall)
    return 1;
  const double by_width = wide.value_or(0) / box[2];
  const double by_height = tall.value_or(0) / box[3];
  if (!wide || !tall)
    return wide ? by_width : by_height;
  constexpr double alike = 0.01;
  if (std::abs(by_width - by_height) > alike * by_width)
    say(rules::CourseScale, place(root, "viewBox"),
        texts::TwoScales(fmt::format("{:.4g}", by_width), fmt::format("{:.4g}", by_height)),
        texts::SmallerCounts(fmt::format("height=\"{:.6g}cm\"", by_width * box[3])));
  return std::min(by_width, by_height);
}

std::optional<double> CourseReader::size_cm(const pugi::xml_node& root, const char* attribute) {
  const std::string_view text = trim(root.attribute(attribute).value());
  const auto digits = std::min(text.find_first_not_of("0123456789."), text.size());
  const auto unit = trim(text.substr(digits));
  const auto value = parse_number<double>(text.substr(0, digits), std::chars_format::fixed);
  const bool plain = text.empty() || ((unit.empty() || unit == "%") && value);
  const auto* const found =
      std::find_if(units.begin(), units.end(), [&](const Unit& row) { return row.name == unit; });
  if (plain)
    return std::nullopt;
  if (!value || *value <= 0 || found == units.end()) {
    say(rules::CourseValue, place(root, attribute), texts::NotASize(text), texts::WriteSize());
    return std::nullopt;
  }
  return *value * found->cm;
}

void CourseReader::walk(const Element& parent, int depth) {
  if (depth > most_groups) {
    say(rules::CourseTooLarge, place(parent.node), texts::NestedGroups(most_groups),
        texts::Ungroup());
    return;
  }
  for (const auto& node : parent.node.children()) {
    if (node.type() != pugi::node_element || stop_)
      continue;
    if (++elements_ > most_elements) {
      say(rules::CourseTooLarge, place(node), texts::ManyElements(most_elements),
          texts::DeleteRest());
      stop_ = true;
      return;
    }
    enter(parent, node, depth);
  }
}

void CourseReader::enter(const Element& parent, const pugi::xml_node& node, int depth) {
  const auto name = local_name(node.name());
  if (std::find(hidden_elements.begin(), hidden_elements.end(), name) != hidden_elements.end() ||
      name.find(':') != std::string_view::npos || property(node, "display") == "none")
    return;
  const auto own = role_of(node);
  const Element element{node, name, parent.to_cm * transform(node),
                        own == Role::None ? parent.role : own};
  if (name == "g" || name == "a" || name == "switch")
    return walk(element, depth + 1);
  if (own == Role::None && (name == "text" || name == "image"))
    return; // text and images on a layer of walls
  switch (element.role) {
  case Role::None:
    if (name == "svg")
      walk(element, depth + 1);
    return;
  case Role::Wall: return wall(element);
  case Role::Zone: return zone(element);
  case Role::Start: return start(element);
  }
}

Role CourseReader::role_of(const pugi::xml_node& node) {
  for (const auto* attribute : {"class", "inkscape:label", "label"}) {
    std::string_view words = node.attribute(attribute).value();
    while (!(words = trim(words)).empty()) {
      const auto word = words.substr(0, words.find_first_of(" \t\n"));
      words.remove_prefix(word.size());
      const auto* const found =
          std::find_if(role_names.begin(), role_names.end(),
                       [&](const RoleName& row) { return equal_words(row.word, word); });
      if (found != role_names.end())
        return found->role;
      doubt(node, attribute, word);
    }
  }
  return Role::None;
}

void CourseReader::doubt(const pugi::xml_node& node, std::string_view attribute,
                         std::string_view word) {
  std::vector<std::string_view> names;
  for (const auto& row : role_names)
    names.push_back(row.word);
  const auto meant = closest(word, names);
  if (meant && (meant->size() != word.size() ||
                std::is_permutation(word.begin(), word.end(), meant->begin())))
    say(rules::CourseName, place(node, attribute), texts::IsDecoration(word),
        texts::DidYouMean(*meant));
}

Matrix CourseReader::transform(const pugi::xml_node& node) {
  if (!property(node, "transform").empty() && node.attribute("transform").empty())
    say(rules::CourseValue, place(node, "style"), texts::TransformInStyle(), texts::AsAttribute());
  const auto read = svg::read_transform(node.attribute("transform").value());
  tell(node, "transform", read.mistake);
  return read.matrix;
}

void CourseReader::tell(const pugi::xml_node& node, std::string_view attribute,
                        const std::optional<svg::Mistake>& mistake) {
  if (mistake)
    say(rules::CourseValue, place(node, attribute, mistake->span),
        texts::InAttribute(attribute, mistake->message), mistake->help);
}

std::vector<double> CourseReader::attribute_numbers(const pugi::xml_node& node,
                                                    const char* attribute) {
  const auto read = svg::read_numbers(node.attribute(attribute).value());
  tell(node, attribute, read.mistake);
  return read.mistake ? std::vector<double>() : read.values;
}

double CourseReader::number(const pugi::xml_node& node, const char* attribute) {
  auto text = trim(node.attribute(attribute).value());
  if (text.ends_with("px"))
    text.remove_suffix(2);
  if (text.empty())
    return 0;
  const auto value = parse_number<double>(text.front() == '+' ? text.substr(1) : text);
  if (!value || !std::isfinite(*value)) {
    say(rules::CourseValue, place(node, attribute), texts::NotPlain(attribute, text),
        texts::SetsUnit());
    return 0;
  }
  return *value;
}

void CourseReader::refuse(const Element& element) {
  const auto at = place(element.node);
  if (element.name == "use")
    say(rules::CourseShape, at, texts::ClonesUnread(), texts::UnlinkClone());
  else if (element.role == Role::Start)
    say(rules::CourseShape, at, texts::CannotBeStart(element.name), texts::StartsAre());
  else if (element.role == Role::Zone)
    say(rules::CourseShape, at, texts::CannotBeZone(element.name), texts::ZonesAre());
  else
    say(rules::CourseShape, at, texts::CannotBeWall(element.name), texts::WallsAre());
}

CourseReading read_course(const Source& drawing) {
  return CourseReader(drawing).read();
}

} // namespace orb::report
