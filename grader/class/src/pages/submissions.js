"use strict";
{
  const table = document.querySelector("table.sortable");
  const body = table.tBodies[0];
  const rows = [...body.rows];

  const filter = document.getElementById("filter");
  const label = document.createElement("label");
  const input = document.createElement("input");
  const count = document.createElement("span");
  input.type = "search";
  label.append("Filter: ", input);
  filter.append(label, " ", count);
  input.addEventListener("input", () => {
    const words = input.value.toLowerCase().split(/\s+/);
    let shown = 0;
    for (const row of rows) {
      const text = row.textContent.toLowerCase();
      row.hidden = !words.every((word) => text.includes(word));
      shown += row.hidden ? 0 : 1;
    }
    count.textContent = input.value.trim() ? `${shown} of ${rows.length}` : "";
  });

  // Empty cells are last in both directions. Names are in the order of a reader's language.
  const compare = (column, isNumber, sign) => (a, b) => {
    const [x, y] = [a, b].map((row) => row.cells[column].textContent);
    if (!x || !y) return (x ? 0 : 1) - (y ? 0 : 1);
    return sign * (isNumber ? x - y : x.localeCompare(y));
  };
  [...table.tHead.rows[0].cells].forEach((head, column) => {
    const button = document.createElement("button");
    button.append(...head.childNodes);
    head.append(button);
    button.addEventListener("click", () => {
      const isNumber = head.classList.contains("number");
      const first = isNumber ? "descending" : "ascending";
      const other = isNumber ? "ascending" : "descending";
      const order = head.ariaSort === first ? other : first;
      for (const cell of table.tHead.rows[0].cells) cell.ariaSort = null;
      head.ariaSort = order;
      body.append(...rows.sort(compare(column, isNumber, order === "ascending" ? 1 : -1)));
    });
  });
}
