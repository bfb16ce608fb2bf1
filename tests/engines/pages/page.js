// Runs the page's engine on what /task asks for, and posts every picture, or what went wrong, back to the program that serves this page.

const post = (path, body) => fetch(path, { method: "POST", body });
const fail = (what) => post("/failed", String(what?.stack ?? what));
addEventListener("error", (event) => fail(event.error ?? event.message));
addEventListener("unhandledrejection", (event) => fail(event.reason));
for (const level of ["warn", "error"]) {
  const print = console[level];
  console[level] = (...words) => {
    post("/said", words.map(String).join(" "));
    print(...words);
  };
}

const task = await (await fetch("/task")).json();
try {
  const { draw } = await import(`/pages/${task.page}`);
  const { loadLight } = await import("/snippet.js");
  // draw() calls back with the name of each picture and its linear floats.
  await draw({ ...task, loadLight, show: (name, rgb) => post(`/picture/${name}`, rgb) });
  await post("/done", "");
  location.reload();
} catch (error) {
  await fail(error);
}
