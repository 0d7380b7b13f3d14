// Addresses that follow from one tube-end on the lattice found, for each way in which the numbers
// can run.

/** The ways to choose from: those that the settings leave, or all where they leave none. */
export function waysToChoose(lattice) {
  const ways = lattice && lattice.found ? lattice.ways || [] : [];
  const likely = ways.filter((way) => way.likely);
  return likely.length ? likely : ways;
}

/** The address of `element` when `anchor` has `address` and the numbers run by `way`. */
export function addressOf(element, anchor, address, way) {
  const i = element.i - anchor.i;
  const j = element.j - anchor.j;
  return {
    row: address.row + way.a * i + way.b * j,
    column: address.column + way.c * i + way.d * j,
  };
}

/**
 * The anchor and the two elements nearest to it that are not in line with it: what a start is made
 * from.
 */
export function threeTubes(elements, anchor) {
  const near = elements
    .filter((element) => element !== anchor)
    .sort(
      (one, other) =>
        Math.hypot(one.u - anchor.u, one.v - anchor.v) -
        Math.hypot(other.u - anchor.u, other.v - anchor.v),
    );
  const first = near[0];
  const second = near.find(
    (element) =>
      first &&
      (first.i - anchor.i) * (element.j - anchor.j) !==
        (first.j - anchor.j) * (element.i - anchor.i),
  );
  return second ? [anchor, first, second] : null;
}
