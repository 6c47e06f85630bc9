#include "playground/engine/robot.h"

#include "base/text/utf8.h"
#include "run/delivery.h"

#include <utility>

namespace orb::playground {
namespace {

using spec::ApiCommand;

/// Stops programs, macros and the wheels, in this order: nothing is left that could drive again.
constexpr ApiCommand stops[] = {ApiCommand::AbortOrbbasicProgram, ApiCommand::AbortMacro,
                                ApiCommand::Roll};

Bytes data_of_stop(ApiCommand command) {
  return command == ApiCommand::Roll ? Bytes(4, 0) : Bytes{};
}

Bytes start_of(const uploader::Delivery& delivery, std::uint8_t seq) {
  if (delivery.program) {
    Bytes data{static_cast<std::uint8_t>(delivery.program->area)};
    append_u16(data, delivery.program->start_line.value_or(0));
    return encode(protocol::make_command(ApiCommand::ExecuteOrbbasicProgram, data, seq));
  }
  const auto& job = delivery.macros.front().job;
  const auto id =
      job.kind == uploader::MacroKind::Temporary ? spec::macro_id_temporary : job.image.id;
  return encode(protocol::make_command(ApiCommand::RunMacro, {id}, seq));
}

} // namespace

Answer tell_robot(Request& request) {
  auto seq = request.value<std::uint8_t>("seq").value_or(0);
  Bytes packets;
  if (request.text("what") == "stop") {
    for (const auto command : stops)
      encode(protocol::make_command(command, data_of_stop(command), seq++), packets);
    return print({{"bytes", bytes_json(packets)}});
  }
  const auto inputs = request.inputs();
  if (!inputs)
    return tl::unexpected(inputs.error());
  run::DeliveryOptions options;
  options.area = request.text("area", "ram") == "flash" ? spec::Area::Flash : spec::Area::Ram;
  options.run = true;
  const auto delivery = run::arrange(*inputs, options);
  if (!delivery)
    return refuse(delivery.error());
  return print({{"bytes", bytes_json(start_of(*delivery, seq))}});
}

Answer RobotEar::hear(Request& request) {
  const auto bytes = bytes_of(request.params.at("bytes"));
  std::string prints;
  std::string error;
  decoder_.feed(bytes);
  while (const auto item = decoder_.next()) {
    if (item->kind != protocol::Item::Kind::Async)
      continue;
    if (item->code == static_cast<std::uint8_t>(spec::AsyncId::BasicPrint))
      prints += as_text(item->data);
    else if (item->code == static_cast<std::uint8_t>(spec::AsyncId::BasicErrorText))
      error += as_text(item->data);
  }
  return print({{"prints", from_latin1(prints)}, {"error", from_latin1(error)}});
}

} // namespace orb::playground
