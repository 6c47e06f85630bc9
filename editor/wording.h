#pragma once

// Places and edits in the words of the Language Server Protocol. Only the server's own files see
// its JSON.

#include "base/diagnostic.h"
#include "base/source.h"
#include "editor/text.h"

#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

namespace orb::editor {

#ifdef __EMSCRIPTEN__
using Json = nlohmann::ordered_json; // the documents need that kind, and a page loads one, not two
#else
using Json = nlohmann::json;
#endif

/// The member `name` of `json`, or null where there is none or `json` is not an object.
const Json& member(const Json& json, const char* name);

/// The string that `json` is; empty for anything else.
std::string text_of(const Json& json);

struct Wording {
  PositionEncoding encoding = PositionEncoding::Utf16;

  Ruler ruler(const Source& source) const { return {source, encoding}; }
  Json position(const Source& source, std::uint32_t offset) const;
  Json range(const Source& source, Span span) const { return range(ruler(source), span); }
  static Json range(Ruler&& ruler, Span span) { return range(ruler, span); }
  static Json range(Ruler& ruler, Span span);
  Json edit(const Source& source, const Edit& one) const;
  Json edits(const Source& source, const std::vector<Edit>& many) const;
  /// The edits that make `text` of all of it; none where it is that already.
  Json replace_all(const Source& source, const std::string& text) const;

  /// The place that `json` says; nothing where it is none.
  std::optional<std::uint32_t> offset(const Source& source, const Json& json) const;
  std::optional<Span> span(const Source& source, const Json& json) const;
};

} // namespace orb::editor
