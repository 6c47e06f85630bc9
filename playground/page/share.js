// The address that contains a program, to copy or to scan with a phone.

import { $, copy, on_demand, say } from "./dom.js";
import { AddressError, to_fragment } from "./workspace.js";

export const address_of = async what => `${location.origin === "null" ? "file://" : location.origin}${location.pathname}#${await to_fragment(what)}`;
const with_codes = on_demand(() => import("uqr"));

/** The address as a QR code, if it is short enough. */
function show_code(link) {
  const most = 2331; // bytes in the largest code with error correction for a seventh
  $("share-code").hidden = link.length > most;
  $("share-lacks").textContent = link.length > most ? "The program is too long for a QR code, but it is in the address." : "";
  if (link.length <= most) with_codes(({ renderSVG }) => { $("share-code").innerHTML = renderSVG(link, { ecc: "M", border: 2 }); });
}

/** Returns a function that shows the address of the workspace. */
export function set_up_share({ workspace }) {
  async function share() {
    try {
      const link = await address_of({ ...workspace(), name: "" });
      $("share-link").value = link;
      $("share-dialog").showModal();
      $("share-link").select();
      show_code(link);
    } catch (error) {
      say(error instanceof AddressError ? error.message : `Cannot create an address: ${error.message}`, "bad");
    }
  }
  $("share").addEventListener("click", share);
  $("share-copy").addEventListener("click", async () => {
    await copy($("share-link"));
    $("share-copy").textContent = "Copied";
    setTimeout(() => { $("share-copy").textContent = "Copy"; }, 1500);
  });
  return share;
}
