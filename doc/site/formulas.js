// SPDX-License-Identifier: LGPL-2.1-or-later
document.addEventListener("DOMContentLoaded", function () {
  if (typeof renderMathInElement === "undefined") return;
  document.querySelectorAll(".math").forEach(function (element) {
    renderMathInElement(element, {
      delimiters: [
        { left: "\\(", right: "\\)", display: false },
        { left: "\\[", right: "\\]", display: true },
      ],
    });
  });
});
