// The parts of the editor that page/edu/javascript.js, loaded later, shares with the page; the build fails if one is missing
// here.

import { EditorState, Facet, Prec, RangeSetBuilder, StateEffect, StateField } from "@codemirror/state";
import { Decoration, Direction, EditorView, ViewPlugin, hoverTooltip, logException } from "@codemirror/view";

globalThis.orb_editor = {
  "@codemirror/state": { EditorState, Facet, Prec, RangeSetBuilder, StateEffect, StateField },
  "@codemirror/view": { Decoration, Direction, EditorView, ViewPlugin, hoverTooltip, logException },
};
