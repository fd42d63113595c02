
// A click on a pale curve, or on a row of the table, brings the method forward in all plots of its problem.
(function () {
  function toggle(at) {
    var section = at.closest("section"), name = at.getAttribute("data-method"), on = !at.classList.contains("forward");
    section.querySelectorAll("[data-method]").forEach(function (other) {
      if (other.getAttribute("data-method") !== name) return;
      other.classList.toggle("forward", on);
      if (on) if (other.matches(".curve")) other.parentNode.appendChild(other);
    });
  }
  function found(event) {
    return event.target.closest("[data-method]");
  }
  document.addEventListener("click", function (event) {
    var at = found(event);
    if (at) toggle(at);
  });
  document.addEventListener("keydown", function (event) {
    var at = found(event);
    if (at) if (event.key === "Enter") toggle(at);
  });
  document.querySelectorAll("tr[data-method]").forEach(function (row) {
    row.tabIndex = 0;
  });
})();
