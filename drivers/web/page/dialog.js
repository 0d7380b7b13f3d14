// Questions that have to be answered before anything else goes on.
import { button, labelled, make } from './dom.js';

/**
 * Asks. `fields`: {name: {label, type, required, value}}. Resolves to an object of the fields'
 * values, or null when cancelled (Escape too). The focus stays inside and goes back to where it
 * was. `cancel` null: there is no way out.
 */
export function ask({
  title,
  text = '',
  fields = {},
  accept = 'Yes',
  cancel = 'Cancel',
  grave = false,
  problem = '',
}) {
  return new Promise((resolve) => {
    const before = document.activeElement;
    const inputs = Object.entries(fields).map(([name, field]) => {
      const made = labelled(
        field.label,
        {
          type: field.options ? null : field.type || 'text',
          required: field.required,
          value: field.value || '',
          autocomplete: field.autocomplete || 'off',
          name,
          maxlength: 80,
        },
        field.options ? 'select' : 'input',
      );
      for (const option of field.options || []) {
        made.input.append(make('option', { value: option }, option));
      }
      return [name, made];
    });
    const close = (value) => {
      shade.remove();
      if (before && before.isConnected) {
        before.focus();
      }
      resolve(value);
    };
    const form = make(
      'form',
      {
        class: `dialog${grave ? ' grave' : ''}`,
        onsubmit: (event) => {
          event.preventDefault();
          close(Object.fromEntries(inputs.map(([name, made]) => [name, made.input.value.trim()])));
        },
      },
      make('h2', { id: 'dialog-title' }, title),
      text ? make('p', {}, text) : null,
      problem ? make('p', { class: 'bad', role: 'alert' }, problem) : null,
      inputs.map(([, made]) => made.row),
      make(
        'div',
        { class: 'buttons' },
        make('button', { type: 'submit', class: grave ? 'grave' : 'main' }, accept),
        cancel === null ? null : button(cancel, () => close(null)),
      ),
    );
    const shade = make(
      'div',
      { class: 'shade', role: 'dialog', 'aria-modal': 'true', 'aria-labelledby': 'dialog-title' },
      form,
    );
    shade.addEventListener('keydown', (event) => {
      if (event.key === 'Escape' && cancel !== null) {
        close(null);
      }
      if (event.key !== 'Tab') {
        return;
      }
      const stops = [...form.querySelectorAll('input, select, button')];
      const edge = event.shiftKey ? stops[0] : stops[stops.length - 1];
      if (document.activeElement === edge) {
        event.preventDefault();
        (event.shiftKey ? stops[stops.length - 1] : stops[0]).focus();
      }
    });
    document.body.append(shade);
    // A grave question is not answered by a key pressed twice: the way back has the focus.
    const first =
      form.querySelector('input, select') ||
      form.querySelector(grave ? 'button:last-child' : 'button');
    first.focus();
  });
}
