#include "spec/api.h"

#include <algorithm>

namespace orb::spec {

const ResponseInfo* find_response(std::uint8_t code) {
  const auto* found =
      std::ranges::find(responses, static_cast<ResponseCode>(code), &ResponseInfo::code);
  return found == responses.end() ? nullptr : found;
}

} // namespace orb::spec
