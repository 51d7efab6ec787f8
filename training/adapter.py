"""A trained adapter as a file that llama.cpp reads (GGUF, type adapter).

PyTorch keeps both halves of a head's rotary pairs apart, llama.cpp side by side: the rows of what a head's query
and key are made with are put into its order.
"""
import pathlib

import gguf
import numpy as np
import torch

from kept import sha256_of

NAMES = {
    "self_attn.q_proj": "attn_q",
    "self_attn.k_proj": "attn_k",
    "self_attn.v_proj": "attn_v",
    "self_attn.o_proj": "attn_output",
    "mlp.gate_proj": "ffn_gate",
    "mlp.up_proj": "ffn_up",
    "mlp.down_proj": "ffn_down",
}
BASE_KEY = "saca.base.sha256"


def rotary_rows(weights, heads):
    """Rows in llama.cpp's order. weights: [heads * d, n]"""
    rows = weights.shape[0]
    return weights.reshape(heads, 2, rows // heads // 2, -1).swapaxes(1, 2).reshape(rows, -1)


def torch_rows(weights, heads):
    """Undoes rotary_rows."""
    rows = weights.shape[0]
    return weights.reshape(heads, rows // heads // 2, 2, -1).swapaxes(1, 2).reshape(rows, -1)


def tensors_of(state, heads, key_heads):
    """Pairs of name and matrix. state: of peft.get_peft_model_state_dict"""
    for key, value in sorted(state.items()):
        parts = key.split(".")
        layer = parts[parts.index("layers") + 1]
        module = next(name for name in NAMES if f".{name}." in key)
        half = "lora_a" if "lora_A" in key else "lora_b"
        matrix = value.detach().to(torch.float32).numpy()
        if half == "lora_b" and module.endswith(("q_proj", "k_proj")):
            matrix = rotary_rows(matrix, heads if module.endswith("q_proj") else key_heads)
        yield f"blk.{layer}.{NAMES[module]}.weight.{half}", np.ascontiguousarray(matrix.astype(np.float16))


def write_adapter(path, state, config, alpha, base, name):
    """path: of the file; config: of the base model; base: its GGUF file, whose sha256 the adapter names"""
    unfinished = pathlib.Path(f"{path}.part")
    writer = gguf.GGUFWriter(unfinished, "llama")
    writer.add_type("adapter")
    writer.add_name(name)
    writer.add_license("apache-2.0")
    writer.add_string("adapter.type", "lora")
    writer.add_float32("adapter.lora.alpha", float(alpha))
    writer.add_string(BASE_KEY, sha256_of(base))
    for tensor, matrix in tensors_of(state, config.num_attention_heads, config.num_key_value_heads):
        writer.add_tensor(tensor, matrix)
    writer.write_header_to_file()
    writer.write_kv_data_to_file()
    writer.write_tensors_to_file()
    writer.close()
    unfinished.rename(path)


class OtherAdapter(ValueError):
    """The file is no adapter of this base."""


def read_adapter(path, config, base):
    """What write_adapter wrote, as peft.set_peft_model_state_dict takes it, and its alpha. What it was rounded to stays."""
    try:
        reader = gguf.GGUFReader(path)
        told = {key: field.contents() for key, field in reader.fields.items()}
    except (OSError, ValueError, IndexError) as error:
        raise OtherAdapter(f"want a GGUF file: {error}") from None
    if told.get("adapter.type") != "lora":
        raise OtherAdapter("want an adapter, got other weights")
    if told.get(BASE_KEY) != sha256_of(base):
        raise OtherAdapter(f"want an adapter of {base}, got one of other weights")
    modules = {short: module for module, short in NAMES.items()}
    state = {}
    for tensor in reader.tensors:
        _, layer, short, _, half = tensor.name.split(".")
        module = modules[short]
        matrix = np.array(tensor.data, dtype=np.float32)
        if half == "lora_b" and module.endswith(("q_proj", "k_proj")):
            matrix = torch_rows(matrix, config.num_attention_heads if module.endswith("q_proj") else config.num_key_value_heads)
        state[f"base_model.model.model.layers.{layer}.{module}.{'lora_A' if half == 'lora_a' else 'lora_B'}.weight"] = torch.from_numpy(
            np.ascontiguousarray(matrix))
    return state, told["adapter.lora.alpha"]
