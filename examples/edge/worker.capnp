using Workerd = import "/workerd/workerd.capnp";

const config :Workerd.Config = (
  services = [(name = "touchpath", worker = .touchpath)],
  sockets = [(name = "http", address = "127.0.0.1:8080", http = (), service = "touchpath")],
);

const touchpath :Workerd.Worker = (
  modules = [
    (name = "worker.js", esModule = embed "dist/worker.js"),
    (name = "./touchpath.wasm", wasm = embed "dist/touchpath.wasm"),
  ],
  compatibilityDate = "2026-01-01",
);
