"""What the tests of section 6 compute together, once: contacts, runs and claims by wear law."""

from __future__ import annotations

from functools import cache

from wheelset.studies import worn_claims, worn_profiles, worn_speeds

P = worn_profiles.Parameters()


@cache
def contacts(law=P.law):
    return worn_profiles.contacts(P, law)


@cache
def curves(law=P.law):
    return worn_profiles.contact_frame(contacts(law))


@cache
def conicity(law=P.law):
    return worn_profiles.conicity_frame(contacts(law))


@cache
def claims(law=P.law):
    profiles = worn_profiles.profile_frame(law, half=0.060)
    return worn_claims.figure_claims(profiles, contacts(law), curves(law), conicity(law))


@cache
def runs(law=P.law):
    return worn_speeds.runs(P, contacts(law))


@cache
def table(law=P.law):
    return worn_speeds.table_4(runs(law))


def sentences(item):
    return claims()[claims()["item"] == item.item]
