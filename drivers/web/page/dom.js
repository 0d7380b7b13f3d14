// Elements made and found in one line each.

/**
 * Makes an element. `attributes`: name to text, true (set, empty), or a function for `on...`; null
 * is left out.
 *  Children are elements or text; null is left out. */
export function make(tag, attributes = {}, ...children) {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (typeof value === 'function') {
      element.addEventListener(name.slice(2), value);
    } else if (value !== null && value !== undefined && value !== false) {
      element.setAttribute(name, value === true ? '' : String(value));
    }
  }
  element.append(...children.flat().filter((child) => child !== null && child !== undefined));
  return element;
}

export function button(text, onclick, attributes = {}) {
  return make('button', { type: 'button', onclick, ...attributes }, text);
}

let fields = 0;

/** An input with its label in front of it; returns {row, input}. */
export function labelled(text, attributes = {}, tag = 'input') {
  fields += 1;
  const id = `field-${fields}`;
  const input = make(tag, { id, ...attributes });
  return { row: make('div', { class: 'field' }, make('label', { for: id }, text), input), input };
}

/** A whole number as somebody typed it, or null. */
export function wholeNumber(text) {
  return /^\s*[+-]?\d{1,6}\s*$/.test(text) ? Number(text) : null;
}

/** Writes text only where it changed: readers of the screen are not told the same twice. */
export function tell(element, text) {
  if (element.textContent !== text) {
    element.textContent = text;
  }
}

/** A number with so many digits behind the point, or a dash where it is not known. */
export function digits(value, count, unit = '') {
  return typeof value === 'number' && Number.isFinite(value)
    ? `${value.toFixed(count)}${unit}`
    : '–';
}

/** Offers a file that the page made. */
export function save(name, type, content) {
  const url = URL.createObjectURL(
    content instanceof Blob ? content : new Blob([content], { type }),
  );
  const link = make('a', { href: url, download: name });
  document.body.append(link);
  link.click();
  link.remove();
  setTimeout(() => URL.revokeObjectURL(url), 10000);
}
