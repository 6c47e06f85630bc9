#pragma once

// Places and edits as JSON of the Language Server Protocol. Only the server's own files use its
// JSON.

#include "base/diagnostic.h"
#include "base/source.h"
#include "editor/text_places.h"

#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

namespace orb::editor {

#ifdef __EMSCRIPTEN__
// same type as the documents use: the playground's page then loads only one
using Json = nlohmann::ordered_json;
#else
using Json = nlohmann::json;
#endif

/// The member `name` of `json`; null if there is none or `json` is not an object.
const Json& member(const Json& json, const char* name);

/// The string in `json`; empty for other types.
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
  /// Edits that replace all of the text with `text`; none if they are equal.
  Json replace_all(const Source& source, const std::string& text) const;

  /// The byte at the position in `json`; nothing if it is not a position.
  std::optional<std::uint32_t> offset(const Source& source, const Json& json) const;
  std::optional<Span> span(const Source& source, const Json& json) const;
};

} // namespace orb::editor
