# ruff: noqa: E501
"""What instruments are called, and which sound a name means."""

import pytest

from reina.music.instrument_names import instruments_of_name, program_of_name, spellings

ROWS = [(instrument, name.rstrip(".")) for instrument, names in spellings().items() for name in names]


def test_every_name_is_recognised_as_its_instrument():
    assert [(i, name) for i, name in ROWS if i not in instruments_of_name(name)] == []


def test_no_row_takes_the_sound_of_one_below():
    programs = {
        instrument: program_of_name(names[0].rstrip(".")) for instrument, names in spellings().items()
    }
    wrong = [(i, name, program_of_name(name)) for i, name in ROWS if program_of_name(name) != programs[i]]
    assert [row for row in wrong if programs[row[0]] is not None] == []


@pytest.mark.parametrize(
    ("row", "names"),
    [
        (
            "trumpet",
            "Trumpet, Trompete, Trompette, Trompeta, Trompete em Si b, Tromba, Trombe, Trumpet i B, Trompet, Trumpetti, "
            "Trąbka, Trąbki, Trubka, Trumpeta, Trúbka, Trombita, Truba, Trube, Trompetă, Trompete, Труба, Труби, Тромпет, "
            "Τρομπέτα, חצוצרה, トランペット, ﾄﾗﾝﾍﾟｯﾄ, 小号, 小號, 트럼펫",
        ),
        ("cornet", "Cornet, Kornett, Cornet à pistons, Cornetto, Corneta, Kornet, Корнет, Κορνέτα, コルネット, 短号, 短號, 코넷"),
        ("flugelhorn", "Flugelhorn, Flügelhorn, Bugelhoorn, Flicorno, Fliscorno, Skrzydłówka, Křídlovka, Szárnykürt, Флюгельгорн, フリューゲルホルン, 플루겔혼"),
        ("euphonium", "Euphonium, Eufonio, Eufonium, Tenorhorn, Эуфониум, ユーフォニアム, 上低音号, 유포늄"),
        ("tuba", "Tuba, Tubă, Tuuba, Sousaphone, Туба, Τούμπα, טובה, チューバ, 大号, 低音號, 튜바"),
        ("trombone", "Trombone, Posaune, Puzon, Pozoun, Harsona, Trombon, Тромбон, Τρομπόνι, טרומבון, トロンボーン, 长号, 長號, 트롬본"),
        ("horn", "Horn in F, Waldhorn, Cor, Corno, Trompa, Hoorn, Róg, Waltornia, Lesní roh, Kürt, Rog, Corn, Валторна, Κόρνο, קרן יער, ホルン, 圆号, 圓號, 호른"),
        ("flute", "Flute, Flöte, Querflöte, Flûte, Flauta, Flauto, Flöjt, Tvärflöjt, Huilu, Fluit, Flet, Flétna, Fuvola, Flaut, Flüt, Флейта, Флаут, Φλάουτο, חליל, フルート, 长笛, 長笛, 플루트"),
        ("clarinet", "Clarinet, Klarinette, Clarinette, Clarinete, Clarinetto, Klarinett, Klarnet, Klarinet, Klarinét, Кларнет, Кларинет, Κλαρίνο, קלרינט, クラリネット, 单簧管, 單簧管, 클라리넷"),
        ("saxophone", "Alto Sax, Saxophon, Saxofón, Saksofon, Saxofon, Szaxofon, Саксофон, Σαξόφωνο, סקסופון, サックス, 萨克斯, 薩克斯風, 색소폰"),
        ("violin", "Violin I, Violine, Geige, Violon, Violín, Violino, Fiol, Viulu, Viool, Skrzypce, Housle, Hegedű, Violina, Vioară, Keman, Скрипка, Цигулка, Βιολί, כינור, バイオリン, 小提琴, 바이올린"),
        ("cello", "Cello, Violoncello, Violoncelle, Violonchelo, Wiolonczela, Čelo, Gordonka, Виолончель, Τσέλο, צ'לו, チェロ, 大提琴, 첼로"),
        ("guitar", "Guitar, Gitarre, Guitare, Guitarra, Chitarra, Gitarr, Kitara, Gitaar, Gitara, Kytara, Gitár, Chitară, Gitar, Гитара, Гітара, Китара, Κιθάρα, גיטרה, ギター, 吉他, 結他, 기타"),
        ("piano", "Piano, Klavier, Pianoforte, Fortepian, Klavír, Zongora, Klavir, Pian, Piyano, Flygel, Фортепиано, Фортепіано, Пиано, Πιάνο, פסנתר, ピアノ, 钢琴, 鋼琴, 피아노"),
        ("other percussion", "Drums, Schlagzeug, Batterie, Batería, Bateria, Batteria, Trummor, Rummut, Slagwerk, Perkusja, Bicí, Dob, Bubnjevi, Tobă, Davul, Ударные, Ударні, Барабани, Ντραμς, תופים, ドラム, 鼓, 드럼"),
        ("choir", "Choir, Chor, Chœur, Coro, Kör, Kuoro, Koor, Chór, Sbor, Kórus, Zbor, Хор, Χορωδία, מקהלה, コーラス, 合唱, 합창"),
        ("vocals", "Vocals, Gesang, Chant, Voz, Voce, Sång, Laulu, Zang, Śpiew, Zpěv, Ének, Glas, Вокал, Голос, Φωνή, שירה, ボーカル, 人声, 人聲, 보컬"),
    ],
)  # fmt: skip
def test_names_of_an_instrument_in_many_languages(row: str, names: str):
    missing = [name.strip() for name in names.split(",") if row not in instruments_of_name(name.strip())]
    assert missing == []


@pytest.mark.parametrize(
    ("name", "program"),
    [
        ("Basstrompete", 56),
        ("SoloTrumpet", 56),
        ("Altposaune", 57),
        ("Bassposaune", 57),
        ("Bassklarinette", 71),
        ("Baritone Sax", 67),
        ("Mundharmonika", 22),
        ("Akkordeon", 21),
        ("手風琴", 21),
        ("Cor anglais", 69),
        ("Corno inglese", 69),
        ("Rożek angielski", 69),
        ("Bajo eléctrico", 33),
        ("Бас-гитара", 33),
        ("Контрабас", 43),
        ("Lead Guitar", 24),
        ("String Bass", 43),
        ("二胡", 110),
        ("Track 3", None),
        ("", None),
    ],
)
def test_programs_by_name(name: str, program: int | None):
    assert program_of_name(name) == program


@pytest.mark.parametrize(
    "name", ["Trubadur", "Alt", "Arpeggio", "Bella ciao", "Rogers", "Corner", "Cordelia"]
)
def test_words_that_only_begin_like_an_instrument(name: str):
    assert instruments_of_name(name) == ()
