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

/// The member `name` of `json`, or null where there is none or `json` is not an object.
const nlohmann::json& member(const nlohmann::json& json, const char* name);

/// The string that `json` is; empty for anything else.
std::string text_of(const nlohmann::json& json);

struct Wording {
  PositionEncoding encoding = PositionEncoding::Utf16;

  nlohmann::json position(const Source& source, std::uint32_t offset) const;
  nlohmann::json range(const Source& source, Span span) const;
  nlohmann::json edit(const Source& source, const Edit& one) const;
  nlohmann::json edits(const Source& source, const std::vector<Edit>& many) const;
  /// The edits that make `text` of all of it; none where it is that already.
  nlohmann::json replace_all(const Source& source, const std::string& text) const;

  /// The place that `json` says; nothing where it is none.
  std::optional<std::uint32_t> offset(const Source& source, const nlohmann::json& json) const;
  std::optional<Span> span(const Source& source, const nlohmann::json& json) const;
};

} // namespace orb::editor
