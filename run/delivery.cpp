#include "run/delivery.h"

#include "base/refuse.h"

#include <algorithm>
#include <fmt/format.h>
#include <set>
#include <utility>

namespace orb::run {
namespace {

/// The kind of macro requested by the user or by the file.
uploader::MacroKind macro_kind(const DeliveryOptions& options, const Macro& macro) {
  if (options.kind)
    return *options.kind;
  return options.id ? uploader::MacroKind::User : uploader::natural_kind(macro.image);
}

bool is_kept(const uploader::Delivery::NamedMacro& macro) {
  return macro.job.kind == uploader::MacroKind::User;
}

} // namespace

tl::expected<uploader::Delivery, Failure> arrange(std::span<const Input> inputs,
                                                  const DeliveryOptions& options) {
  if (const auto numbered = check_start_line(inputs, options.line); !numbered)
    return tl::unexpected(numbered.error());
  uploader::Delivery delivery;
  std::set<std::uint8_t> ids;
  for (const auto& input : inputs) {
    for (const auto& macro : input.macros) {
      uploader::MacroJob job{macro.image, macro_kind(options, macro), false, false};
      job.image.id = options.id.value_or(job.image.id);
      if (job.kind == uploader::MacroKind::User && !ids.insert(job.image.id).second)
        return refuse(ExitCode::Usage,
                      fmt::format("{}: two macros have id {}", macro.name, job.image.id));
      job.clear_others = options.clear_macros && delivery.macros.empty();
      delivery.macros.push_back({macro.name, std::move(job)});
    }
    if (!input.program)
      continue;
    if (delivery.program)
      return refuse(ExitCode::Usage,
                    fmt::format("{}: a ball holds one program, but {} was already given",
                                input.source->name(), delivery.program_name));
    delivery.program_name = input.source->name();
    const auto& bytes = input.program->image.bytes;
    const auto start = options.line.value_or(input.program->first_line().value_or(1));
    delivery.program = uploader::ProgramJob{{bytes.begin(), bytes.end()},
                                            options.area,
                                            options.run ? std::optional(start) : std::nullopt};
  }
  if (std::count_if(delivery.macros.begin(), delivery.macros.end(), std::not_fn(is_kept)) > 1)
    return refuse(ExitCode::Usage,
                  "a ball holds only one temporary or streamed macro; give the others ids from "
                  "32 to 253");
  if (options.run && !delivery.program && !delivery.macros.empty())
    delivery.macros.back().job.run = true;
  return delivery;
}

} // namespace orb::run
