// What of the editor a language that comes later needs (page/edu/javascript.js): there is one editor on the page, and the
// build says what is missing here.

import { EditorState, Facet, Prec, RangeSetBuilder, StateEffect, StateField } from "@codemirror/state";
import { Decoration, Direction, EditorView, ViewPlugin, hoverTooltip, logException } from "@codemirror/view";

globalThis.orb_editor = {
  "@codemirror/state": { EditorState, Facet, Prec, RangeSetBuilder, StateEffect, StateField },
  "@codemirror/view": { Decoration, Direction, EditorView, ViewPlugin, hoverTooltip, logException },
};
