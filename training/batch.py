"""Sequences as tensors: what a step is made of."""
import dataclasses

import torch

UNSEEN = torch.finfo(torch.float32).min


@dataclasses.dataclass
class Batch:
    tokens: torch.Tensor  # [B, L]
    positions: torch.Tensor  # [B, L], behind the system part
    unseen: torch.Tensor  # [B, 1, L, S + L]: 0, or UNSEEN where a token must not look
    rows: torch.Tensor  # [N] example of each prediction
    sources: torch.Tensor  # [N] token that it is made from
    targets: torch.Tensor  # [N]
    weights: torch.Tensor  # [N]
    at_once: torch.Tensor  # [B], which of the predictions are answers that no reasoning precedes
    shares: torch.Tensor  # [B, 8], how much each answer counts there


def batch_of(sequences, system_length, pad_token):
    longest = max(len(s.tokens) for s in sequences)
    tokens = torch.full((len(sequences), longest), pad_token)
    positions = torch.zeros((len(sequences), longest), dtype=torch.long)
    unseen = torch.full((len(sequences), 1, longest, system_length + longest), UNSEEN)
    unseen[..., :system_length] = 0.0
    predictions = []
    at_once = []
    for row, s in enumerate(sequences):
        length = len(s.tokens)
        tokens[row, :length] = torch.tensor(s.tokens)
        positions[row, :length] = torch.tensor(s.position)
        branch = torch.tensor(s.branch)
        place = torch.arange(length)
        same = (branch[None, :] == branch[:, None]) | (branch[None, :] == 0)
        prompt = s.branch.count(0)
        same |= (branch[:, None] == 3) & (branch[None, :] == 1) & (place[None, :] < prompt + s.cut)
        seen = same & (place[None, :] <= place[:, None])
        unseen[row, 0, :length, system_length:system_length + length][seen] = 0.0
        predicted = [i for i in range(length) if s.weight[i] > 0.0]
        at_once.append(len(predictions) + predicted.index(s.at_once))
        predictions += [(row, s.source[i], s.tokens[i], s.weight[i]) for i in predicted]
    rows, sources, targets, weights = zip(*predictions)
    return Batch(tokens, positions, unseen, torch.tensor(rows), torch.tensor(sources), torch.tensor(targets),
                 torch.tensor(weights), torch.tensor(at_once), torch.tensor([s.shares for s in sequences]))
