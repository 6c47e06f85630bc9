// The fields of blocks. A field holds the text as written, so that nothing is lost.

import { t } from "../dom.js";

/** What `read_numeral` accepts, with an optional minus sign. */
const numeral = /^-?(?:0x[0-9a-f]+|\d+|\d+(?:\.\d{1,9})?(?:ms|s|min))$/i;
const milliseconds = { ms: 1, s: 1000, min: 60_000 };
const value_of = text => {
  const unit = /(ms|s|min)$/i.exec(text)?.[0] ?? "";
  return unit ? Math.round(parseFloat(text) * milliseconds[unit.toLowerCase()]) : Number(text);
};
const name = /^[a-z_]\w*$/i;
/** Characters of a comment, or of a line without a block. */
const longest_shown = 70;

export function make_fields({ FieldTextInput, FieldDropdown, dialog }, words) {
  const taken = new Set([...words.statements, ...words.sensors, ...words.functions, ...words.keywords].map(({ word }) => word.toLowerCase()));
  const is_name = text => name.test(text) && text.length <= words.longest_name && !taken.has(text.toLowerCase());

  /** A number as written: `0x7F`, `1.5s`. Typing is limited to the range of its place. */
  class NumeralField extends FieldTextInput {
    doClassValidation_(text) {
      text = String(text).trim();
      if (!this.isBeingEdited_) return text;
      if (!numeral.test(text)) return null;
      const range = this.range();
      if (!range) return text;
      const value = value_of(text);
      return value < range.least ? String(range.least) : value > range.greatest ? String(range.greatest) : text;
    }
    /** The range from the tables. */
    range() {
      const input = this.getSourceBlock()?.outputConnection?.targetConnection?.getParentInput();
      return input?.getSourceBlock().ranges?.[input.name];
    }
  }

  /** A text that may be long: cut at a word's end, so that what is shown is part of what a screen reader reads. */
  class LongField extends FieldTextInput {
    getDisplayText_() {
      const text = this.getText();
      const end = text.length <= longest_shown ? text.length : text.lastIndexOf(" ", longest_shown - 1);
      const shown = text.slice(0, end > 0 ? end : longest_shown - 1).replace(/\s/g, "\u00a0");
      return shown.length < text.length ? shown + "…" : shown;
    }
  }

  /** A text; `fits` decides what may be typed. */
  class CheckedField extends FieldTextInput {
    constructor(text, fits) {
      super(text);
      this.fits = fits;
    }
    doClassValidation_(text) {
      return !this.isBeingEdited_ || this.fits(text) ? text : null;
    }
  }
  const list_of_names = text => text.trim() === "" || text.split(",").every(one => is_name(one.trim()));

  /** A choice among `options(block)`, evaluated on opening. The current value is always among them. */
  class ChoiceField extends FieldDropdown {
    constructor(value, options, { look = one => one || " ", more = [] } = {}) {
      super(function () {
        const own = this.coming ?? this.value_ ?? value;
        if (!this.opening) return [[look(own), own]];
        const list = options(this.getSourceBlock());
        return [...list.includes(own) ? list : [own, ...list], ...more].map(one => [look(one), one]);
      });
      this.setValue(value);
    }
    doClassValidation_(value) {
      return value;
    }
    doValueUpdate_(value) {
      this.coming = value;
      this.getOptions(false);
      super.doValueUpdate_(value);
      this.coming = undefined;
    }
    showEditor_(event) {
      this.opening = true;
      super.showEditor_(event);
    }
    dropdownDispose_() {
      this.opening = false;
      super.dropdownDispose_();
    }
  }

  /** The entry for a new name; `of` gives the kind. */
  const another = "\n";
  class NameField extends ChoiceField {
    constructor(value, of) {
      super(value, ({ workspace }) => names_in(workspace.targetWorkspace ?? workspace, of), { more: [another], look: one => one === another ? t("another name…") : one });
    }
    doClassValidation_(value) {
      if (value !== another) return value;
      dialog.prompt(t("Name"), this.getValue(), text => {
        if (text !== null && is_name(text.trim())) this.setValue(text.trim());
      });
      return null;
    }
  }

  return { NumeralField, LongField, CheckedField, ChoiceField, NameField, is_name, list_of_names };
}

/** The distinct names that a program's blocks define, of the kinds in `of`. */
export function names_in(workspace, of) {
  const names = new Map();
  for (const block of workspace.getAllBlocks(false))
    for (const [kind, name] of block.makes())
      if (of.includes(kind) && name && !names.has(name.toLowerCase())) names.set(name.toLowerCase(), name);
  return [...names.values()];
}
